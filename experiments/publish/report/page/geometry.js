// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Rotations and places in doubles: where a body is at a time, and the plane of a certificate.
// Nothing is drawn here.
const rotation = ([w, x, y, z]) => {
  const s = w * w + x * x + y * y + z * z;
  return [
    (w * w + x * x - y * y - z * z) / s,
    (2 * (x * y - w * z)) / s,
    (2 * (x * z + w * y)) / s,
    (2 * (x * y + w * z)) / s,
    (w * w - x * x + y * y - z * z) / s,
    (2 * (y * z - w * x)) / s,
    (2 * (x * z - w * y)) / s,
    (2 * (y * z + w * x)) / s,
    (w * w - x * x - y * y + z * z) / s,
  ];
};
const turned = (k, angle) => {
  const l = Math.hypot(...k) || 1,
    s = Math.sin(angle / 2) / l;
  return rotation([Math.cos(angle / 2), s * k[0], s * k[1], s * k[2]]);
};
const mul3 = (A, B) => {
  const C = [];
  for (let i = 0; i < 3; i++)
    for (let j = 0; j < 3; j++)
      C.push(A[3 * i] * B[j] + A[3 * i + 1] * B[3 + j] + A[3 * i + 2] * B[6 + j]);
  return C;
};
const apply = (R, v) => [
  R[0] * v[0] + R[1] * v[1] + R[2] * v[2],
  R[3] * v[0] + R[4] * v[1] + R[5] * v[2],
  R[6] * v[0] + R[7] * v[1] + R[8] * v[2],
];
const applyT = (R, v) => [
  R[0] * v[0] + R[3] * v[1] + R[6] * v[2],
  R[1] * v[0] + R[4] * v[1] + R[7] * v[2],
  R[2] * v[0] + R[5] * v[1] + R[8] * v[2],
];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2],
  norm = (a) => Math.hypot(a[0], a[1], a[2]);
const plus = (a, b, s = 1) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]],
  cross = (a, b) => [
    a[1] * b[2] - a[2] * b[1],
    a[2] * b[0] - a[0] * b[2],
    a[0] * b[1] - a[1] * b[0],
  ];
const unit = (a) => {
  const l = norm(a) || 1;
  return [a[0] / l, a[1] / l, a[2] / l];
};

// One body's pose at each t of the step, relative to `origin`: it turns by k, theta about its point
// `about`.
function pathOf(side, i, origin, moving) {
  const c = D.cases,
    of = (name) => c[`${name}${side}`][i],
    R0 = rotation(side ? c.quaternion_b[i] : c.quaternion_a[i]),
    p0 = plus(side ? c.position_b[i] : c.position_a[i], origin, -1),
    d = of("displacement"),
    k = of("axis"),
    theta = moving ? of("angle") : 0,
    arm = apply(R0, of("about"));
  const turn = (t) => (theta && t ? turned(k, theta * t) : null);
  const pose = (t) => {
    const T = turn(t),
      p = moving ? plus(p0, d, t) : p0;
    return T ? { R: mul3(T, R0), p: plus(plus(p, arm), apply(T, arm), -1) } : { R: R0, p };
  };
  return { turn, pose, theta, moves: moving && Boolean(theta || norm(d)) };
}

// A case's geometry without any drawing: poses relative to A's at the start, the plane of its
// certificate at a time.
async function geometryOf(i) {
  const c = D.cases,
    [ia, ib] = D.drawn[i],
    a = await body(ia),
    b = await body(ib);
  const origin = c.position_a[i],
    moving = c.question[i] !== "overlap",
    A = pathOf("", i, origin, moving),
    B = pathOf("_b", i, origin, moving);
  const turns = Boolean(A.theta || B.theta);
  return {
    i,
    a,
    b,
    A,
    B,
    poseA: A.pose,
    poseB: B.pose,
    turns,
    moving,
    origin,
    proof: D.proofs[i] || {},
  };
}

function elementVertices(bodyOf, order, from, to) {
  if (to === null || bodyOf.kind === "convex") return null;
  const found = new Set();
  let offsets;
  if (bodyOf.pieces) {
    offsets = [0];
    for (const [n] of bodyOf.pieces) offsets.push(offsets.at(-1) + n);
  }
  for (let j = from; j < to; j++) {
    const e = order ? order[j] : j;
    if (bodyOf.pieces) for (let v = offsets[e]; v < offsets[e + 1]; v++) found.add(v);
    else for (let q = 0; q < 3; q++) found.add(bodyOf.faces[3 * e + q]);
  }
  return found;
}

// The tightest plane of the proof at time t: normal, middle, clearance, which elements; relative to
// p_A. null where none is for t.
function planeAt(g, proof, t) {
  if (!proof?.leaves) return null;
  let best = null,
    count = 0;
  const A = g.poseA(t),
    B = g.poseB(t),
    // what a normal that is fixed in a body has turned by
    turn = { A: g.A.turn(t), B: g.B.turn(t) };
  for (const leaf of proof.leaves) {
    const [s, e, frame, nx, ny, nz, a0, a1, b0, b1] = leaf;
    if (t < s || t > e) continue;
    count++;
    const n = unit(turn[frame] ? apply(turn[frame], [nx, ny, nz]) : [nx, ny, nz]);
    leaf.va ||= elementVertices(g.a, proof.order_a, a0, a1) || "all";
    leaf.vb ||= elementVertices(g.b, proof.order_b, b0, b1) || "all";
    const top = extreme(g.a, leaf.va, A, n, 1),
      bottom = extreme(g.b, leaf.vb, B, n, -1),
      gap = bottom.value - top.value;
    if (!best || gap < best.gap)
      best = { n, gap, top, bottom, middle: (top.value + bottom.value) / 2, frame, leaf };
  }
  return best && { ...best, count };
}

function extreme(bodyOf, which, pose, n, sign) {
  const local = applyT(pose.R, n),
    v = bodyOf.vertices;
  let value = -Infinity,
    at = 0;
  const look = (j) => {
    const f = sign * (local[0] * v[3 * j] + local[1] * v[3 * j + 1] + local[2] * v[3 * j + 2]);
    if (f > value) {
      value = f;
      at = j;
    }
  };
  if (which === "all") for (let j = 0, m = v.length / 3; j < m; j++) look(j);
  else which.forEach(look);
  return {
    value: sign * value + dot(pose.p, n),
    point: plus(apply(pose.R, [v[3 * at], v[3 * at + 1], v[3 * at + 2]]), pose.p),
  };
}

function corners(bodyOf) {
  // the eight corners of its box, kept
  return (bodyOf.box ||= (() => {
    const low = [Infinity, Infinity, Infinity],
      high = [-Infinity, -Infinity, -Infinity],
      v = bodyOf.vertices;
    for (let j = 0; j < v.length; j++) {
      const k = j % 3;
      if (v[j] < low[k]) low[k] = v[j];
      if (v[j] > high[k]) high[k] = v[j];
    }
    const all = [];
    for (let q = 0; q < 8; q++)
      all.push([q & 1 ? high[0] : low[0], q & 2 ? high[1] : low[1], q & 4 ? high[2] : low[2]]);
    return all;
  })());
}
const ball = (bodyOf) => {
  const q = corners(bodyOf);
  return [plus(q[0], q[7]).map((x) => x / 2), norm(plus(q[7], q[0], -1)) / 2];
};
const radius = (bodyOf) => ball(bodyOf)[1];
