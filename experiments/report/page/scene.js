// Both bodies of one case in 3D, at any time of the step. Positions are taken in doubles about the middle of the scene, and only then drawn.
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
    for (let j = 0; j < 3; j++) C.push(A[3 * i] * B[j] + A[3 * i + 1] * B[3 + j] + A[3 * i + 2] * B[6 + j]);
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
  cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => {
  const l = norm(a) || 1;
  return [a[0] / l, a[1] / l, a[2] / l];
};

// A case's geometry without any drawing: poses, the plane of its certificate at a time.
async function geometryOf(i) {
  const c = D.cases,
    [ia, ib] = D.drawn[i],
    a = await body(ia),
    b = await body(ib);
  const RA = rotation(c.quaternion_a[i]),
    RB = rotation(c.quaternion_b[i]),
    d = c.displacement[i],
    k = c.axis[i],
    theta = c.angle[i],
    moving = c.question[i] !== "overlap";
  const dp = plus(c.position_b[i], c.position_a[i], -1); // exact enough: both are float32 numbers
  // relative to p_A
  const poseA = (t) => ({
    R: theta && t ? mul3(turned(k, theta * t), RA) : RA,
    p: moving ? [d[0] * t, d[1] * t, d[2] * t] : [0, 0, 0],
  });
  const poseB = { R: RB, p: dp };
  return { i, a, b, poseA, poseB, k, theta, moving, origin: c.position_a[i], proof: D.proofs[i] || {} };
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

// The tightest plane of the proof at time t: normal, middle, clearance, which elements; relative to p_A. null where none is for t.
function planeAt(g, proof, t) {
  if (!proof?.leaves) return null;
  let best = null,
    count = 0;
  const A = g.poseA(t),
    RT = g.theta && t ? turned(g.k, g.theta * t) : null;
  for (const leaf of proof.leaves) {
    const [s, e, frame, nx, ny, nz, a0, a1, b0, b1] = leaf;
    if (t < s || t > e) continue;
    count++;
    const n = unit(frame === "A" && RT ? apply(RT, [nx, ny, nz]) : [nx, ny, nz]);
    ((leaf.va ||= elementVertices(g.a, proof.order_a, a0, a1) || "all"),
      (leaf.vb ||= elementVertices(g.b, proof.order_b, b0, b1) || "all"));
    const top = extreme(g.a, leaf.va, A, n, 1),
      bottom = extreme(g.b, leaf.vb, g.poseB, n, -1),
      gap = bottom.value - top.value;
    if (!best || gap < best.gap) best = { n, gap, top, bottom, middle: (top.value + bottom.value) / 2, frame, leaf };
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
    if (f > value) ((value = f), (at = j));
  };
  if (which === "all") for (let j = 0, m = v.length / 3; j < m; j++) look(j);
  else which.forEach(look);
  return { value: sign * value + dot(pose.p, n), point: plus(apply(pose.R, [v[3 * at], v[3 * at + 1], v[3 * at + 2]]), pose.p) };
}

const MANY = 6000; // faces from which the edges of a body are not drawn

class BodyScene {
  constructor(canvas, still = false) {
    const T = THREE;
    this.still = still;
    this.renderer = new T.WebGLRenderer({
      canvas,
      antialias: true,
      alpha: true,
      logarithmicDepthBuffer: true,
      preserveDrawingBuffer: still,
    });
    this.scene = new T.Scene();
    this.camera = new T.PerspectiveCamera(32, 1, 1e-6, 1e3);
    this.scene.add(new T.HemisphereLight(0xffffff, 0x8090a0, 1.6));
    this.lamp = new T.DirectionalLight(0xffffff, 1.5);
    this.camera.add(this.lamp);
    this.lamp.position.set(0.6, 1, 1.4);
    this.scene.add(this.camera);
    this.root = new T.Group();
    this.scene.add(this.root);
    this.options = { seeThrough: true, ghosts: true, plane: true, selections: true };
    if (!still) {
      this.controls = new T.OrbitControls(this.camera, canvas);
      this.controls.enableDamping = false;
      this.controls.addEventListener("change", () => this.draw());
    }
    this.recolour();
  }

  recolour() {
    const css = (name) => new THREE.Color(colour(`var(${name})`) || "#888888");
    this.colours = {
      a: css("--body-a"),
      b: css("--body-b"),
      ink: css("--ink"),
      plane: css("--plane"),
      chosen: css("--chosen"),
      met: css("--met"),
      should: css("--should"),
    };
    if (this.g) {
      this.build();
      this.time(this.t);
    }
  }

  async show(g, overlay = null) {
    ((this.g = g), (this.overlay = overlay));
    if (overlay) this.seen = [await body(overlay.bodies[0]), await body(overlay.bodies[1])];
    const ends = !g.moving
      ? [0]
      : g.theta
        ? [...Array(49).keys()].map((j) => j / 48 + (j % 48 ? 0.003 * Math.sin(7 * j) : 0))
        : [0, 1]; // uneven: full turns come back
    const low = [Infinity, Infinity, Infinity],
      high = [-Infinity, -Infinity, -Infinity];
    const grow = (p) => {
      for (let k = 0; k < 3; k++) ((low[k] = Math.min(low[k], p[k])), (high[k] = Math.max(high[k], p[k])));
    };
    for (const t of ends)
      corners(g.a).forEach((v) => {
        const P = g.poseA(t);
        grow(plus(apply(P.R, v), P.p));
      });
    corners(g.b).forEach((v) => grow(plus(apply(g.poseB.R, v), g.poseB.p)));
    this.middle = plus(low, high).map((x) => x / 2);
    this.size = norm(plus(high, low, -1)) / 2 || 1;
    this.build();
  }

  place(pose) {
    // body frame (in units of the scene) -> scene
    const { R } = pose,
      p = plus(pose.p, this.middle, -1).map((x) => x / this.size);
    return new THREE.Matrix4().set(R[0], R[1], R[2], p[0], R[3], R[4], R[5], p[1], R[6], R[7], R[8], p[2], 0, 0, 0, 1);
  }

  point(p) {
    return plus(p, this.middle, -1).map((x) => x / this.size);
  }

  geometry(bodyOf, faces) {
    const T = THREE,
      index = faces || [...Array(bodyOf.faces.length / 3).keys()],
      positions = new Float32Array(9 * index.length);
    index.forEach((f, j) => {
      for (let q = 0; q < 3; q++)
        for (let k = 0; k < 3; k++) positions[9 * j + 3 * q + k] = bodyOf.vertices[3 * bodyOf.faces[3 * f + q] + k] / this.size;
    });
    const made = new T.BufferGeometry();
    made.setAttribute("position", new T.BufferAttribute(positions, 3));
    made.computeVertexNormals();
    return made;
  }

  build() {
    const T = THREE,
      g = this.g,
      { a, b, ink, chosen, met, should } = this.colours,
      o = this.options;
    this.clear(this.root);
    this.movers = [];
    const add = (object, moves) => {
      object.matrixAutoUpdate = false;
      this.root.add(object);
      if (moves) this.movers.push(object);
      else object.matrix.copy(this.place(g.poseB));
      object.updateMatrixWorld(true);
      return object;
    };
    for (const [bodyOf, shade, moves] of [
      [g.a, a, true],
      [g.b, b, false],
    ]) {
      const shape = this.geometry(bodyOf);
      add(
        new T.Mesh(
          shape,
          new T.MeshLambertMaterial({
            color: shade,
            flatShading: true,
            transparent: o.seeThrough,
            opacity: o.seeThrough ? 0.36 : 1,
            depthWrite: !o.seeThrough,
            side: T.DoubleSide,
            polygonOffset: true,
            polygonOffsetFactor: 1,
            polygonOffsetUnits: 1,
          }),
        ),
        moves,
      );
      if (bodyOf.faces.length / 3 <= MANY) {
        const edges = new T.EdgesGeometry(shape, 2);
        add(new T.LineSegments(edges, new T.LineBasicMaterial({ color: shade.clone().lerp(ink, 0.25) })), moves);
        if (moves && g.moving && o.ghosts)
          for (const t of [0, 1]) {
            const ghost = add(
              new T.LineSegments(edges, new T.LineBasicMaterial({ color: shade, transparent: true, opacity: 0.3 })),
            );
            ghost.matrix.copy(this.place(g.poseA(t)));
            ghost.updateMatrixWorld(true);
          }
      }
    }
    if (this.overlay && o.selections) {
      const [sa, sb] = this.seen,
        x = this.overlay;
      const paint = (bodyOf, faces, shade, opacity, moves, rank) => {
        if (!faces.length) return;
        const m = add(
          new T.Mesh(
            this.geometry(bodyOf, faces),
            new T.MeshBasicMaterial({
              color: shade,
              transparent: true,
              opacity,
              side: T.DoubleSide,
              depthWrite: false,
              polygonOffset: true,
              polygonOffsetFactor: -rank,
              polygonOffsetUnits: -rank,
            }),
          ),
          moves,
        );
        m.renderOrder = 2 + rank;
        const positions = m.geometry.getAttribute("position").array,
          segments = [];
        for (let j = 0; j < positions.length; j += 9)
          for (let q = 0; q < 3; q++)
            segments.push(
              ...positions.slice(j + 3 * q, j + 3 * q + 3),
              ...positions.slice(j + 3 * ((q + 1) % 3), j + 3 * ((q + 1) % 3) + 3),
            );
        add(this.thick(segments, shade, rank > 1 ? 2.6 : 1.4, 1), moves).renderOrder = 3 + rank;
      };
      paint(sa, x.a, a, 0.75, true, 1);
      paint(sb, x.b, b, 0.75, false, 1);
      if (x.should) {
        paint(sa, [x.should.faces[0]], should, 0.9, true, 2);
        paint(sb, [x.should.faces[1]], should, 0.9, false, 2);
      }
      if (x.met) {
        paint(sa, [x.met[0]], met, 0.9, true, 2);
        paint(sb, [x.met[1]], met, 0.9, false, 2);
      }
      if (g.moving) {
        const [t0, t1] = x.window,
          lines = this.chords(sa, x.a, g.poseA(t0), g.poseA(t1));
        this.root.add(this.thick(lines, chosen, 1.6, 0.85));
        if (x.vertices_b) this.root.add(this.thick(this.chordsOfB(sb, x.b, g.poseA(t0), g.poseA(t1)), b, 1.2, 0.7));
      }
    }
    this.plane = new T.Group();
    this.root.add(this.plane);
  }

  thick(positions, shade, width, opacity) {
    const T = THREE,
      shape = new T.LineSegmentsGeometry();
    shape.setPositions(positions.length ? positions : [0, 0, 0, 0, 0, 0]);
    const made = new T.LineSegments2(
      shape,
      new T.LineMaterial({ color: shade, linewidth: width, transparent: true, opacity, depthTest: width < 2.6 }),
    );
    made.renderOrder = 2;
    made.frustumCulled = false;
    this.fat = this.fat || new Set();
    this.fat.add(made.material);
    if (this.resolution) made.material.resolution.set(...this.resolution);
    return made;
  }

  chords(bodyOf, faces, P, Q) {
    const lines = [];
    for (const v of new Set(faces.flatMap((f) => [0, 1, 2].map((q) => bodyOf.faces[3 * f + q])))) {
      const x = [0, 1, 2].map((k) => bodyOf.vertices[3 * v + k]);
      lines.push(...this.point(plus(apply(P.R, x), P.p)), ...this.point(plus(apply(Q.R, x), Q.p)));
    }
    return lines;
  }

  chordsOfB(bodyOf, faces, P, Q) {
    // as A sees them at the window's start
    const lines = [],
      B = this.g.poseB;
    for (const v of new Set(faces.flatMap((f) => [0, 1, 2].map((q) => bodyOf.faces[3 * f + q])))) {
      const world = plus(
          apply(
            B.R,
            [0, 1, 2].map((k) => bodyOf.vertices[3 * v + k]),
          ),
          B.p,
        ),
        inA = applyT(Q.R, plus(world, Q.p, -1));
      lines.push(...this.point(world), ...this.point(plus(apply(P.R, inA), P.p)));
    }
    return lines;
  }

  // Poses at time t; the plane, or the common point, that the certificate has for t. Returns what it found.
  time(t) {
    this.t = t;
    const g = this.g,
      T = THREE,
      pose = this.place(g.poseA(g.moving ? t : 0));
    for (const mover of this.movers) {
      mover.matrix.copy(pose);
      mover.updateMatrixWorld(true);
    }
    this.clear(this.plane);
    const c = D.cases,
      hi = c.t_hi[g.i],
      proof = g.proof,
      hit = c.label[g.i] === "hit";
    let found = null;
    if (proof.clear && !(hit && t > c.t_lo[g.i])) found = planeAt(g, proof.clear, t);
    else if (t === 1 && proof.end_clear) found = planeAt(g, proof.end_clear, 1);
    if (found && this.options.plane) this.drawPlane(found);
    const point =
      hit && proof.hit && (!g.moving || Math.abs(t - hi) < 1e-12)
        ? proof.hit.point
        : t === 1 && proof.end_hit
          ? proof.end_hit.point
          : null;
    if (this.options.plane && proof.hit && hit) this.drawPoint(proof.hit.point, point === proof.hit.point);
    if (this.options.plane && point && point !== proof.hit?.point) this.drawPoint(point, true);
    this.draw();
    return { plane: found, point };
  }

  drawPlane({ n, middle, top, bottom }) {
    const T = THREE,
      centre = plus(top.point, bottom.point).map((x) => x / 2),
      on = plus(centre, n, middle - dot(centre, n)),
      p = this.point(on);
    const r = Math.max((Math.min(radius(this.g.a), radius(this.g.b)) / this.size) * 1.3, 0.08);
    const u = unit(cross(n, Math.abs(n[0]) < 0.8 ? [1, 0, 0] : [0, 1, 0])),
      w = cross(n, u);
    const corner = (x, y) => plus(plus(p, u, x * r), w, y * r),
      q = [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)];
    const shape = new T.BufferGeometry();
    shape.setAttribute("position", new T.Float32BufferAttribute([...q[0], ...q[1], ...q[2], ...q[0], ...q[2], ...q[3]], 3));
    const sheet = new T.Mesh(
      shape,
      new T.MeshBasicMaterial({
        color: this.colours.plane,
        transparent: true,
        opacity: 0.28,
        side: T.DoubleSide,
        depthWrite: false,
      }),
    );
    sheet.renderOrder = 1;
    this.plane.add(
      sheet,
      this.thick([...q[0], ...q[1], ...q[1], ...q[2], ...q[2], ...q[3], ...q[3], ...q[0]], this.colours.plane, 2, 1),
    );
  }

  drawPoint(point, now) {
    const T = THREE,
      shape = new T.BufferGeometry();
    shape.setAttribute("position", new T.Float32BufferAttribute(this.point(plus(point, this.g.origin, -1)), 3));
    const dots = new T.Points(
      shape,
      new T.PointsMaterial({
        color: now ? this.colours.met : this.colours.ink,
        size: (now ? 12 : 7) * (this.still ? 0.7 : 1),
        sizeAttenuation: false,
        depthTest: false,
        transparent: true,
        opacity: now ? 1 : 0.55,
      }),
    );
    dots.material.onBeforeCompile = (shader) => {
      shader.fragmentShader = shader.fragmentShader.replace(
        "void main() {",
        "void main() {\n if (length(gl_PointCoord - 0.5) > 0.5) discard;",
      );
    };
    dots.renderOrder = 9;
    this.plane.add(dots);
  }

  // Where a viewer would stand: across the plane of the proof, or across the motion.
  aim(what = "all") {
    const g = this.g,
      c = D.cases,
      t = c.t_lo[g.i] ?? 0,
      found = planeAt(g, g.proof.clear, t);
    const n = found ? found.n : norm(c.displacement[g.i]) ? unit(c.displacement[g.i]) : [1, 0, 0];
    let side = cross(n, [0, 0, 1]);
    if (norm(side) < 0.2) side = cross(n, [0, 1, 0]);
    const direction = unit(
      plus(
        plus(
          unit(side).map((x) => 0.9 * x),
          n,
          -0.3,
        ),
        [0, 0, 1],
        0.42,
      ),
    );
    let target = [0, 0, 0],
      reach = 1;
    const A = g.poseA(g.moving ? this.t || 0 : 0);
    if (what === "a" || what === "b") {
      const [one, pose] = what === "a" ? [g.a, A] : [g.b, g.poseB];
      const [m, r] = ball(one);
      ((target = this.point(plus(apply(pose.R, m), pose.p))), (reach = r / this.size));
    }
    if (what === "contact") {
      const at = g.proof.hit
        ? plus(g.proof.hit.point, g.origin, -1)
        : found && found.gap > 0
          ? plus(found.top.point, found.bottom.point).map((x) => x / 2)
          : null;
      if (at) ((target = this.point(at)), (reach = (0.16 * Math.min(ball(g.a)[1], ball(g.b)[1])) / this.size));
    }
    const distance = reach / Math.sin((0.5 * this.camera.fov * Math.PI) / 180) / Math.min(1, this.camera.aspect);
    this.camera.up.set(0, 0, 1);
    this.camera.position.set(...plus(target, direction, distance));
    ((this.camera.near = 1e-5 * distance), (this.camera.far = distance + 10));
    this.camera.updateProjectionMatrix();
    this.camera.lookAt(...target);
    if (this.controls) {
      this.controls.target.set(...target);
      this.controls.update();
    }
    this.draw();
  }

  orbit(right, up, closer = 1) {
    const T = THREE,
      target = this.controls.target,
      offset = this.camera.position.clone().sub(target);
    offset.applyAxisAngle(new T.Vector3(0, 0, 1), right);
    const axis = new T.Vector3().crossVectors(this.camera.up, offset).normalize();
    const tilted = offset.clone().applyAxisAngle(axis, -up);
    if (Math.abs(tilted.z) < 0.98 * tilted.length()) offset.copy(tilted);
    this.camera.position.copy(target).add(offset.multiplyScalar(closer));
    this.controls.update();
    this.draw();
  }

  resize(width, height, ratio = Math.min(devicePixelRatio || 1, 2)) {
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.resolution = [width, height];
    this.fat?.forEach((m) => m.resolution.set(width, height));
    this.draw();
  }

  draw() {
    if (this.g) this.renderer.render(this.scene, this.camera);
  }

  clear(group) {
    group.traverse((o) => {
      if (o !== group) {
        o.geometry?.dispose();
        this.fat?.delete(o.material);
        o.material?.dispose();
      }
    });
    group.clear();
  }

  close() {
    this.clear(this.root);
    this.controls?.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }
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
    for (let q = 0; q < 8; q++) all.push([q & 1 ? high[0] : low[0], q & 2 ? high[1] : low[1], q & 4 ? high[2] : low[2]]);
    return all;
  })());
}
const ball = (bodyOf) => {
  const q = corners(bodyOf);
  return [plus(q[0], q[7]).map((x) => x / 2), norm(plus(q[7], q[0], -1)) / 2];
};
const radius = (bodyOf) => ball(bodyOf)[1];
