# parry by cargo, for generic machines and for x86-64-v3.
set(CARGO_NEEDED 1.89)  # by the crate wide, which parry computes with
find_program(CARGO cargo HINTS $ENV{HOME}/.cargo/bin)
set(CARGO_VERSION 0)
if(CARGO)
  execute_process(COMMAND ${CARGO} --version OUTPUT_VARIABLE CARGO_SAYS ERROR_QUIET)
  string(REGEX MATCH "[0-9]+\\.[0-9]+\\.[0-9]+" CARGO_VERSION "${CARGO_SAYS}")
endif()

function(parry_plugin name isa flags crate)
  set(target ${crate}/target-${isa})
  set(library ${target}/release/libparry_lane.a)
  add_custom_command(OUTPUT ${library}
    COMMAND ${CMAKE_COMMAND} -E env "RUSTFLAGS=${flags}"
      ${CARGO} build --quiet --release --manifest-path ${crate}/Cargo.toml --target-dir ${target}
    DEPENDS ${crate}/src/lib.rs ${crate}/Cargo.toml)
  add_custom_target(${name}_crate DEPENDS ${library})
  file(STRINGS ${crate}/Cargo.toml version REGEX "^parry3d-f64")
  string(REGEX MATCH "[0-9]+\\.[0-9]+\\.[0-9]+" version "${version}")
  lane_plugin(${name} parry ${isa} "parry ${version} built by cargo ${CARGO_VERSION} with LTO")
  add_dependencies(${name}_plugin ${name}_crate)
  target_link_libraries(${name}_plugin PRIVATE ${library})
endfunction()

if(CARGO_VERSION VERSION_LESS CARGO_NEEDED)
  set(REMEDY "install Rust's cargo ${CARGO_NEEDED} or later by rustup; Debian's package is older")
  if(CARGO)
    set(REMEDY "${CARGO} is ${CARGO_VERSION}, ${REMEDY}")
  endif()
  missing(parry "${REMEDY}")
  missing(parry_v3 "as parry")
else()
  # Copied, so that cargo's lock file stays out of the sources.
  set(CRATE ${CMAKE_BINARY_DIR}/parry)
  configure_file(parry/Cargo.toml ${CRATE}/Cargo.toml COPYONLY)
  configure_file(parry/src/lib.rs ${CRATE}/src/lib.rs COPYONLY)
  parry_plugin(parry generic "" ${CRATE})
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    parry_plugin(parry_v3 ${V3} "-C target-cpu=${V3}" ${CRATE})
  else()
    missing(parry_v3 "x86-64-v3 is of another machine")
  endif()
endif()
