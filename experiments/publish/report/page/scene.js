// Both bodies of one case in 3D, at any time of the step. Positions are taken in doubles about the middle of the scene, and only then drawn.
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
      : g.turns
        ? [...Array(49).keys()].map((j) => j / 48 + (j % 48 ? 0.003 * Math.sin(7 * j) : 0))
        : [0, 1]; // uneven: full turns come back
    const low = [Infinity, Infinity, Infinity],
      high = [-Infinity, -Infinity, -Infinity];
    const grow = (p) => {
      for (let k = 0; k < 3; k++) ((low[k] = Math.min(low[k], p[k])), (high[k] = Math.max(high[k], p[k])));
    };
    for (const t of ends)
      for (const [bodyOf, path] of [
        [g.a, g.A],
        [g.b, g.B],
      ]) {
        const P = path.pose(t);
        corners(bodyOf).forEach((v) => grow(plus(apply(P.R, v), P.p)));
      }
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
    const add = (object, path) => {
      // path: whose pose it follows; null: it keeps the one that it is given
      object.matrixAutoUpdate = false;
      this.root.add(object);
      if (path) this.movers.push([object, path]);
      return object;
    };
    for (const [bodyOf, shade, path] of [
      [g.a, a, g.A],
      [g.b, b, g.B],
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
        path,
      );
      if (bodyOf.faces.length / 3 <= MANY) {
        const edges = new T.EdgesGeometry(shape, 2);
        add(new T.LineSegments(edges, new T.LineBasicMaterial({ color: shade.clone().lerp(ink, 0.25) })), path);
        if (path.moves && o.ghosts)
          for (const t of [0, 1]) {
            const ghost = add(
              new T.LineSegments(edges, new T.LineBasicMaterial({ color: shade, transparent: true, opacity: 0.3 })),
              null,
            );
            ghost.matrix.copy(this.place(path.pose(t)));
            ghost.updateMatrixWorld(true);
          }
      }
    }
    if (this.overlay && o.selections) {
      const [sa, sb] = this.seen,
        x = this.overlay;
      const paint = (bodyOf, faces, shade, opacity, path, rank) => {
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
          path,
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
        add(this.thick(segments, shade, rank > 1 ? 2.6 : 1.4, 1), path).renderOrder = 3 + rank;
      };
      paint(sa, x.a, a, 0.75, g.A, 1);
      paint(sb, x.b, b, 0.75, g.B, 1);
      if (x.should) {
        paint(sa, [x.should.faces[0]], should, 0.9, g.A, 2);
        paint(sb, [x.should.faces[1]], should, 0.9, g.B, 2);
      }
      if (x.met) {
        paint(sa, [x.met[0]], met, 0.9, g.A, 2);
        paint(sb, [x.met[1]], met, 0.9, g.B, 2);
      }
      if (g.moving) {
        this.root.add(this.thick(this.chords(sa, x.a, g.poseA, g.poseB, x.window), chosen, 1.6, 0.85));
        if (x.vertices_b) this.root.add(this.thick(this.chords(sb, x.b, g.poseB, g.poseA, x.window), b, 1.2, 0.7));
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

  // Virtual edges of one body as the other sees them, the other where it is at the window's start.
  chords(bodyOf, faces, own, other, [t0, t1]) {
    const lines = [],
      [P, Q] = [own(t0), own(t1)],
      [S, E] = [other(t0), other(t1)];
    for (const v of new Set(faces.flatMap((f) => [0, 1, 2].map((q) => bodyOf.faces[3 * f + q])))) {
      const x = [0, 1, 2].map((k) => bodyOf.vertices[3 * v + k]),
        seen = applyT(E.R, plus(plus(apply(Q.R, x), Q.p), E.p, -1));
      lines.push(...this.point(plus(apply(P.R, x), P.p)), ...this.point(plus(apply(S.R, seen), S.p)));
    }
    return lines;
  }

  // Poses at time t; the plane, or the common point, that the certificate has for t. Returns what it found.
  time(t) {
    this.t = t;
    const g = this.g,
      at = new Map([g.A, g.B].map((path) => [path, this.place(path.pose(t))]));
    for (const [mover, path] of this.movers) {
      mover.matrix.copy(at.get(path));
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
    const d = plus(c.displacement[g.i], c.displacement_b[g.i], -1),
      n = found ? found.n : norm(d) ? unit(d) : [1, 0, 0];
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
    const now = g.moving ? this.t || 0 : 0;
    if (what === "a" || what === "b") {
      const [one, pose] = what === "a" ? [g.a, g.poseA(now)] : [g.b, g.poseB(now)];
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
