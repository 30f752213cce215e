# FCL with libccd, and Bullet, built for x86-64-v3 of their sources. sources.sh does that apart, as
# it takes minutes.
set(V3_SOURCES "run: make native-v3 (on Debian; it needs dpkg-dev)")

if(EXISTS ${V3_PREFIX}/lib/libfcl.a AND Eigen3_FOUND)
  file(STRINGS ${V3_PREFIX}/include/fcl/config.h FCL_V3_VERSION REGEX "define FCL_VERSION ")
  string(REGEX MATCH "[0-9.]+" FCL_V3_VERSION "${FCL_V3_VERSION}")
  foreach(plugin fcl fcl_casts)
    lane_plugin(${plugin}_v3 ${plugin} ${V3} "FCL ${FCL_V3_VERSION} built by ${HERE} -O3")
    target_include_directories(${plugin}_v3_plugin BEFORE PRIVATE ${V3_PREFIX}/include)
    target_link_libraries(${plugin}_v3_plugin PRIVATE ${V3_PREFIX}/lib/libfcl.a
      ${V3_PREFIX}/lib/libccd.a Eigen3::Eigen)
  endforeach()
else()
  missing(fcl_v3 "${V3_SOURCES}")
  missing(fcl_casts_v3 "as fcl_v3")
endif()

if(EXISTS ${V3_PREFIX}/lib/libBulletCollision-float64.a)
  file(STRINGS ${V3_PREFIX}/include/bullet/LinearMath/btScalar.h NUMBER
    REGEX "define BT_BULLET_VERSION ")
  string(REGEX MATCH "[0-9][0-9][0-9]" NUMBER "${NUMBER}")
  math(EXPR MAJOR "${NUMBER} / 100")
  math(EXPR MINOR "${NUMBER} % 100")
  foreach(plugin bullet bullet_casts)
    lane_plugin(${plugin}_v3 ${plugin} ${V3} "Bullet ${MAJOR}.${MINOR} built by ${HERE} -O3")
    target_include_directories(${plugin}_v3_plugin BEFORE PRIVATE ${V3_PREFIX}/include/bullet)
    target_compile_definitions(${plugin}_v3_plugin PRIVATE BT_USE_DOUBLE_PRECISION)
    target_link_libraries(${plugin}_v3_plugin PRIVATE
      ${V3_PREFIX}/lib/libBulletCollision-float64.a ${V3_PREFIX}/lib/libLinearMath-float64.a)
  endforeach()
else()
  missing(bullet_v3 "${V3_SOURCES}")
  missing(bullet_casts_v3 "as bullet_v3")
endif()
