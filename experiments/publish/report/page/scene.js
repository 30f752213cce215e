// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Both bodies of one case in 3D, at any time of the step. Positions are taken in doubles about the
// middle of the scene, and only then drawn.
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
    this.lines = new Lines();
    this.camera = new Camera(canvas, still, () => this.draw());
    this.root = new T.Group();
    this.scene = new T.Scene();
    this.scene.add(new T.HemisphereLight(0xffffff, 0x8090a0, 1.6), this.camera.eye, this.root);
    this.options = { seeThrough: true, ghosts: true, plane: true, selections: true };
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
    this.g = g;
    this.overlay = overlay;
    if (overlay) this.seen = [await body(overlay.bodies[0]), await body(overlay.bodies[1])];
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    const grow = (p) => {
      for (let k = 0; k < 3; k++) {
        low[k] = Math.min(low[k], p[k]);
        high[k] = Math.max(high[k], p[k]);
      }
    };
    for (const t of this.moments())
      for (const [bodyOf, path] of this.both()) {
        const P = path.pose(t);
        for (const v of corners(bodyOf)) grow(plus(apply(P.R, v), P.p));
      }
    this.middle = plus(low, high).map((x) => x / 2);
    this.size = norm(plus(high, low, -1)) / 2 || 1;
    this.build();
  }

  both() {
    const g = this.g;
    return [
      [g.a, g.A, this.colours.a],
      [g.b, g.B, this.colours.b],
    ];
  }

  // Times at which the bodies are looked at for the size of the scene.
  moments() {
    if (!this.g.moving) return [0];
    if (!this.g.turns) return [0, 1];
    const uneven = (j) => (j % 48 ? 0.003 * Math.sin(7 * j) : 0); // full turns come back
    return Array.from({ length: 49 }, (_, j) => j / 48 + uneven(j));
  }

  // Body frame (in units of the scene) -> scene.
  place(pose) {
    const R = pose.R;
    const p = this.point(pose.p);
    return new THREE.Matrix4().set(
      ...[R[0], R[1], R[2], p[0]],
      ...[R[3], R[4], R[5], p[1]],
      ...[R[6], R[7], R[8], p[2]],
      ...[0, 0, 0, 1],
    );
  }

  point(p) {
    return plus(p, this.middle, -1).map((x) => x / this.size);
  }

  geometry(bodyOf, faces) {
    const index = faces || [...Array(bodyOf.faces.length / 3).keys()];
    const positions = new Float32Array(9 * index.length);
    index.forEach((f, j) => {
      for (let q = 0; q < 3; q++) {
        const v = 3 * bodyOf.faces[3 * f + q];
        for (let k = 0; k < 3; k++)
          positions[9 * j + 3 * q + k] = bodyOf.vertices[v + k] / this.size;
      }
    });
    const made = new THREE.BufferGeometry();
    made.setAttribute("position", new THREE.BufferAttribute(positions, 3));
    made.computeVertexNormals();
    return made;
  }

  // path: whose pose the object follows; null: it keeps the one that it is given.
  add(object, path) {
    object.matrixAutoUpdate = false;
    this.root.add(object);
    if (path) this.movers.push([object, path]);
    return object;
  }

  build() {
    this.clear(this.root);
    this.movers = [];
    for (const [bodyOf, path, shade] of this.both()) this.addBody(bodyOf, path, shade);
    if (this.overlay && this.options.selections) paintSelections(this);
    this.plane = new THREE.Group();
    this.root.add(this.plane);
  }

  addBody(bodyOf, path, shade) {
    const T = THREE;
    const { seeThrough, ghosts } = this.options;
    const shape = this.geometry(bodyOf);
    const material = new T.MeshLambertMaterial({
      color: shade,
      flatShading: true,
      transparent: seeThrough,
      opacity: seeThrough ? 0.36 : 1,
      depthWrite: !seeThrough,
      side: T.DoubleSide,
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
    });
    this.add(new T.Mesh(shape, material), path);
    if (bodyOf.faces.length / 3 > MANY) return;
    const edges = new T.EdgesGeometry(shape, 2);
    const dark = shade.clone().lerp(this.colours.ink, 0.25);
    this.add(new T.LineSegments(edges, new T.LineBasicMaterial({ color: dark })), path);
    if (!path.moves || !ghosts) return;
    for (const t of [0, 1]) {
      const faint = new T.LineBasicMaterial({ color: shade, transparent: true, opacity: 0.3 });
      const ghost = this.add(new T.LineSegments(edges, faint), null);
      ghost.matrix.copy(this.place(path.pose(t)));
      ghost.updateMatrixWorld(true);
    }
  }

  // Poses at time t, and what the certificate has for t. Returns what it has.
  time(t) {
    this.t = t;
    const g = this.g;
    const at = new Map([g.A, g.B].map((path) => [path, this.place(path.pose(t))]));
    for (const [mover, path] of this.movers) {
      mover.matrix.copy(at.get(path));
      mover.updateMatrixWorld(true);
    }
    this.clear(this.plane);
    const found = proofAt(g, t);
    if (this.options.plane) this.drawProof(found);
    this.draw();
    return found;
  }

  drawProof({ plane, point }) {
    const witness = D.cases.label[this.g.i] === "hit" ? this.g.proof.hit?.point : null;
    if (plane) this.plane.add(...planeDrawn(this, plane));
    if (witness) this.plane.add(pointDrawn(this, witness, point === witness));
    if (point && point !== this.g.proof.hit?.point) this.plane.add(pointDrawn(this, point, true));
  }

  // Look across the plane of the proof, or across the motion. what: all, a, b or contact.
  aim(what = "all") {
    const g = this.g;
    const c = D.cases;
    const found = planeAt(g, g.proof.clear, c.t_lo[g.i] ?? 0);
    const d = plus(c.displacement[g.i], c.displacement_b[g.i], -1);
    const along = norm(d) ? unit(d) : [1, 0, 0];
    const n = found ? found.n : along;
    let side = cross(n, [0, 0, 1]);
    if (norm(side) < 0.2) side = cross(n, [0, 1, 0]);
    const level = unit(side).map((x) => 0.9 * x);
    const direction = unit(plus(plus(level, n, -0.3), [0, 0, 1], 0.42));
    const { target, reach } = this.ballOf(what, found);
    this.camera.stand(target, direction, reach);
    this.draw();
  }

  // What is to be in sight: the middle and the radius of a ball, in units of the scene.
  ballOf(what, found) {
    const g = this.g;
    if (what === "a" || what === "b") {
      const now = g.moving ? this.t || 0 : 0;
      const [one, pose] = what === "a" ? [g.a, g.poseA(now)] : [g.b, g.poseB(now)];
      const [m, r] = ball(one);
      return { target: this.point(plus(apply(pose.R, m), pose.p)), reach: r / this.size };
    }
    const at = what === "contact" ? this.contact(found) : null;
    if (!at) return { target: [0, 0, 0], reach: 1 };
    const smaller = Math.min(ball(g.a)[1], ball(g.b)[1]);
    return { target: this.point(at), reach: (0.16 * smaller) / this.size };
  }

  contact(found) {
    if (this.g.proof.hit) return plus(this.g.proof.hit.point, this.g.origin, -1);
    if (!found || !(found.gap > 0)) return null;
    return plus(found.top.point, found.bottom.point).map((x) => x / 2);
  }

  orbit(...turn) {
    this.camera.orbit(...turn);
    this.draw();
  }

  resize(width, height, ratio = Math.min(devicePixelRatio || 1, 2)) {
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    this.camera.resize(width, height);
    this.lines.resize(width, height);
    this.draw();
  }

  draw() {
    if (this.g) this.renderer.render(this.scene, this.camera.eye);
  }

  clear(group) {
    group.traverse((o) => {
      if (o !== group) {
        o.geometry?.dispose();
        this.lines.forget(o.material);
        o.material?.dispose();
      }
    });
    group.clear();
  }

  close() {
    this.clear(this.root);
    this.camera.controls?.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }
}
