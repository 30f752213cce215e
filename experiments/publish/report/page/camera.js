// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Where the viewer stands. `changed` is called when the user moves it; a still camera has no user.
class Camera {
  constructor(canvas, still, changed) {
    this.eye = new THREE.PerspectiveCamera(32, 1, 1e-6, 1e3);
    const lamp = new THREE.DirectionalLight(0xffffff, 1.5);
    lamp.position.set(0.6, 1, 1.4);
    this.eye.add(lamp);
    if (still) return;
    this.controls = new THREE.OrbitControls(this.eye, canvas);
    this.controls.enableDamping = false;
    this.controls.addEventListener("change", changed);
  }

  // Look at a ball of radius `reach` about `target`, from a direction (a unit vector).
  stand(target, direction, reach) {
    const half = (0.5 * this.eye.fov * Math.PI) / 180;
    const distance = reach / Math.sin(half) / Math.min(1, this.eye.aspect);
    this.eye.up.set(0, 0, 1);
    this.eye.position.set(...plus(target, direction, distance));
    this.eye.near = 1e-5 * distance;
    this.eye.far = distance + 10;
    this.eye.updateProjectionMatrix();
    this.eye.lookAt(...target);
    if (this.controls) {
      this.controls.target.set(...target);
      this.controls.update();
    }
  }

  // Turn about the target by angles in radians, and go closer by a factor.
  orbit(right, up, closer = 1) {
    const target = this.controls.target;
    const offset = this.eye.position.clone().sub(target);
    offset.applyAxisAngle(new THREE.Vector3(0, 0, 1), right);
    const axis = new THREE.Vector3().crossVectors(this.eye.up, offset).normalize();
    const tilted = offset.clone().applyAxisAngle(axis, -up);
    if (Math.abs(tilted.z) < 0.98 * tilted.length()) offset.copy(tilted);
    this.eye.position.copy(target).add(offset.multiplyScalar(closer));
    this.controls.update();
  }

  resize(width, height) {
    this.eye.aspect = width / height;
    this.eye.updateProjectionMatrix();
  }
}
