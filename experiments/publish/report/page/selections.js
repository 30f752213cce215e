// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Draws OFG's selections, the faces that met and the virtual edges on the bodies.

// The edges of triangles, as pairs of points. positions: nine numbers for each triangle.
function outline(positions) {
  const segments = [];
  for (let j = 0; j < positions.length; j += 9)
    for (let q = 0; q < 3; q++) {
      const p = j + 3 * q;
      const r = j + 3 * ((q + 1) % 3);
      segments.push(...positions.slice(p, p + 3), ...positions.slice(r, r + 3));
    }
  return segments;
}

// Virtual edges of one body as the other sees them, the other where it is at the window's start.
function chords(scene, bodyOf, faces, own, other, [t0, t1]) {
  const lines = [];
  const [P, Q] = [own(t0), own(t1)];
  const [S, E] = [other(t0), other(t1)];
  const used = faces.flatMap((f) => [0, 1, 2].map((q) => bodyOf.faces[3 * f + q]));
  for (const v of new Set(used)) {
    const x = [0, 1, 2].map((k) => bodyOf.vertices[3 * v + k]);
    const seen = applyT(E.R, plus(plus(apply(Q.R, x), Q.p), E.p, -1));
    lines.push(...scene.point(plus(apply(P.R, x), P.p)));
    lines.push(...scene.point(plus(apply(S.R, seen), S.p)));
  }
  return lines;
}

// Faces of a body in a colour. rank: of two on one another the higher is drawn.
function paintFaces(scene, bodyOf, faces, shade, opacity, path, rank) {
  if (!faces.length) return;
  const material = new THREE.MeshBasicMaterial({
    color: shade,
    transparent: true,
    opacity,
    side: THREE.DoubleSide,
    depthWrite: false,
    polygonOffset: true,
    polygonOffsetFactor: -rank,
    polygonOffsetUnits: -rank,
  });
  const mesh = scene.add(new THREE.Mesh(scene.geometry(bodyOf, faces), material), path);
  mesh.renderOrder = 2 + rank;
  const segments = outline(mesh.geometry.getAttribute("position").array);
  const edges = scene.lines.make(segments, shade, rank > 1 ? 2.6 : 1.4, 1);
  scene.add(edges, path).renderOrder = 3 + rank;
}

function paintSelections(scene) {
  const { g, overlay: x } = scene;
  const [sa, sb] = scene.seen;
  const { a, b, chosen, met, should } = scene.colours;
  paintFaces(scene, sa, x.a, a, 0.75, g.A, 1);
  paintFaces(scene, sb, x.b, b, 0.75, g.B, 1);
  for (const [faces, shade] of [
    [x.should?.faces, should],
    [x.met, met],
  ]) {
    if (!faces) continue;
    paintFaces(scene, sa, [faces[0]], shade, 0.9, g.A, 2);
    paintFaces(scene, sb, [faces[1]], shade, 0.9, g.B, 2);
  }
  if (!g.moving) return;
  const ofA = chords(scene, sa, x.a, g.poseA, g.poseB, x.window);
  scene.root.add(scene.lines.make(ofA, chosen, 1.6, 0.85));
  if (!x.vertices_b) return;
  const ofB = chords(scene, sb, x.b, g.poseB, g.poseA, x.window);
  scene.root.add(scene.lines.make(ofB, b, 1.2, 0.7));
}
