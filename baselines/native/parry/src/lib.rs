// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

//! parry in doubles behind a C interface, for the native lane.
use parry3d_f64::math::{Pose, Rotation, Vector};
use parry3d_f64::query::{
    self, ContactManifold, ContactManifoldsWorkspace, DefaultQueryDispatcher, NonlinearRigidMotion,
    PersistentQueryDispatcher, ShapeCastOptions,
};
use parry3d_f64::shape::{Compound, ConvexPolyhedron, Shape, SharedShape, TriMesh};

#[repr(C)]
pub struct CPose {
    quaternion: [f64; 4], // w x y z, of length 1
    position: [f64; 3],
}

fn pose(p: &CPose) -> Pose {
    let [w, x, y, z] = p.quaternion;
    Pose::from_parts(
        Vector::from_array(p.position),
        Rotation::from_xyzw(x, y, z, w),
    )
}

unsafe fn points(vertices: *const f64, n: usize) -> Vec<Vector> {
    std::slice::from_raw_parts(vertices, 3 * n)
        .chunks(3)
        .map(|v| Vector::new(v[0], v[1], v[2]))
        .collect()
}

/// The hull of the points, or a null pointer where parry makes none.
#[no_mangle]
pub unsafe extern "C" fn parry_hull(vertices: *const f64, n: usize) -> *mut Box<dyn Shape> {
    match ConvexPolyhedron::from_convex_hull(&points(vertices, n)) {
        Some(hull) => Box::into_raw(Box::new(Box::new(hull) as Box<dyn Shape>)),
        None => std::ptr::null_mut(),
    }
}

#[no_mangle]
pub unsafe extern "C" fn parry_mesh(
    vertices: *const f64,
    n: usize,
    faces: *const u32,
    m: usize,
) -> *mut Box<dyn Shape> {
    let triangles = std::slice::from_raw_parts(faces, 3 * m)
        .chunks(3)
        .map(|f| [f[0], f[1], f[2]])
        .collect();
    match TriMesh::new(points(vertices, n), triangles) {
        Ok(mesh) => Box::into_raw(Box::new(Box::new(mesh) as Box<dyn Shape>)),
        Err(_) => std::ptr::null_mut(),
    }
}

/// The union of the hulls, or a null pointer where parry makes none of one.
#[no_mangle]
pub unsafe extern "C" fn parry_compound(
    vertices: *const *const f64,
    n: *const usize,
    pieces: usize,
) -> *mut Box<dyn Shape> {
    let hulls: Option<Vec<_>> = (0..pieces)
        .map(|i| {
            ConvexPolyhedron::from_convex_hull(&points(*vertices.add(i), *n.add(i)))
                .map(|hull| (Pose::IDENTITY, SharedShape::new(hull)))
        })
        .collect();
    match hulls {
        Some(hulls) if !hulls.is_empty() => {
            Box::into_raw(Box::new(Box::new(Compound::new(hulls)) as Box<dyn Shape>))
        }
        _ => std::ptr::null_mut(),
    }
}

#[no_mangle]
pub unsafe extern "C" fn parry_free(shape: *mut Box<dyn Shape>) {
    drop(Box::from_raw(shape));
}

#[no_mangle]
pub unsafe extern "C" fn parry_overlap(
    a: *const Box<dyn Shape>,
    at: &CPose,
    b: *const Box<dyn Shape>,
    bt: &CPose,
) -> bool {
    query::intersection_test(&pose(at), &**a, &pose(bt), &**b)
        .map(|x| x.intersecting)
        .unwrap_or(false)
}

/// Time of impact in [0, 1], or a negative number.
#[no_mangle]
pub unsafe extern "C" fn parry_cast(
    a: *const Box<dyn Shape>,
    at: &CPose,
    d: &[f64; 3],
    b: *const Box<dyn Shape>,
    bt: &CPose,
) -> f64 {
    let options = ShapeCastOptions::with_max_time_of_impact(1.0);
    match query::cast_shapes(
        &pose(at),
        Vector::from_array(*d),
        &**a,
        &pose(bt),
        Vector::ZERO,
        &**b,
        options,
    ) {
        Ok(Some(hit)) => hit.time_of_impact,
        _ => -1.0,
    }
}

/// As `parry_cast`, for a body that also turns about its own origin by `turn` (axis times angle, in
/// the frame of the world).
#[no_mangle]
pub unsafe extern "C" fn parry_cast_nonlinear(
    a: *const Box<dyn Shape>,
    at: &CPose,
    d: &[f64; 3],
    turn: &[f64; 3],
    b: *const Box<dyn Shape>,
    bt: &CPose,
) -> f64 {
    let moving = NonlinearRigidMotion::new(
        pose(at),
        Vector::ZERO,
        Vector::from_array(*d),
        Vector::from_array(*turn),
    );
    let still = NonlinearRigidMotion::constant_position(pose(bt));
    match query::cast_shapes_nonlinear(&moving, &**a, &still, &**b, 0.0, 1.0, true) {
        Ok(Some(hit)) => hit.time_of_impact,
        _ => -1.0,
    }
}

/// What parry keeps of a pair from one call to the next.
#[derive(Default)]
pub struct Manifolds {
    manifolds: Vec<ContactManifold<(), ()>>,
    workspace: Option<ContactManifoldsWorkspace>,
}

#[no_mangle]
pub extern "C" fn parry_manifolds() -> *mut Manifolds {
    Box::into_raw(Box::default())
}

#[no_mangle]
pub unsafe extern "C" fn parry_manifolds_free(kept: *mut Manifolds) {
    drop(Box::from_raw(kept));
}

/// Whether a contact of the manifolds, which start from those of the last call, is no distance.
#[no_mangle]
pub unsafe extern "C" fn parry_manifolds_overlap(
    kept: *mut Manifolds,
    a: *const Box<dyn Shape>,
    at: &CPose,
    b: *const Box<dyn Shape>,
    bt: &CPose,
) -> bool {
    let Manifolds {
        manifolds,
        workspace,
    } = &mut *kept;
    let apart = pose(at).inv_mul(&pose(bt));
    let (a, b) = (&**a, &**b);
    let asked = DefaultQueryDispatcher.contact_manifolds(&apart, a, b, 0.0, manifolds, workspace);
    asked.is_ok()
        && manifolds
            .iter()
            .any(|m| m.points.iter().any(|p| p.dist <= 0.0))
}
