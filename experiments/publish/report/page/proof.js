// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// The part of a certificate that applies to a time: a separating plane or a common point.

function proofAt(g, t) {
  const c = D.cases;
  const hit = c.label[g.i] === "hit";
  const { clear, end_clear, hit: met, end_hit } = g.proof;
  let plane = null;
  if (clear && !(hit && t > c.t_lo[g.i])) plane = planeAt(g, clear, t);
  else if (t === 1 && end_clear) plane = planeAt(g, end_clear, 1);
  let point = null;
  if (hit && met && (!g.moving || Math.abs(t - c.t_hi[g.i]) < 1e-12)) point = met.point;
  else if (t === 1 && end_hit) point = end_hit.point;
  return { plane, point };
}

// A square in the plane, and its outline.
function planeDrawn(scene, { n, middle, top, bottom }) {
  const { a, b } = scene.g;
  const centre = plus(top.point, bottom.point).map((x) => x / 2);
  const p = scene.point(plus(centre, n, middle - dot(centre, n)));
  const r = Math.max((Math.min(radius(a), radius(b)) / scene.size) * 1.3, 0.08);
  const u = unit(cross(n, Math.abs(n[0]) < 0.8 ? [1, 0, 0] : [0, 1, 0]));
  const w = cross(n, u);
  const corner = (x, y) => plus(plus(p, u, x * r), w, y * r);
  const q = [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)];
  const shape = new THREE.BufferGeometry();
  const triangles = [0, 1, 2, 0, 2, 3].flatMap((k) => q[k]);
  shape.setAttribute("position", new THREE.Float32BufferAttribute(triangles, 3));
  const material = new THREE.MeshBasicMaterial({
    color: scene.colours.plane,
    transparent: true,
    opacity: 0.28,
    side: THREE.DoubleSide,
    depthWrite: false,
  });
  const sheet = new THREE.Mesh(shape, material);
  sheet.renderOrder = 1;
  const border = [0, 1, 1, 2, 2, 3, 3, 0].flatMap((k) => q[k]);
  return [sheet, scene.lines.make(border, scene.colours.plane, 2, 1)];
}

// A dot in front of all else. now: the point is common to both bodies at the time that is shown.
function pointDrawn(scene, point, now) {
  const shape = new THREE.BufferGeometry();
  const at = scene.point(plus(point, scene.g.origin, -1));
  shape.setAttribute("position", new THREE.Float32BufferAttribute(at, 3));
  const material = new THREE.PointsMaterial({
    color: now ? scene.colours.met : scene.colours.ink,
    size: (now ? 12 : 7) * (scene.still ? 0.7 : 1),
    sizeAttenuation: false,
    depthTest: false,
    transparent: true,
    opacity: now ? 1 : 0.55,
  });
  material.onBeforeCompile = (shader) => {
    shader.fragmentShader = shader.fragmentShader.replace(
      "void main() {",
      "void main() {\n if (length(gl_PointCoord - 0.5) > 0.5) discard;",
    );
  };
  const dots = new THREE.Points(shape, material);
  dots.renderOrder = 9;
  return dots;
}
