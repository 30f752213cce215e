// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Lines of a width in pixels, whose materials must know the size of the canvas.
class Lines {
  constructor() {
    this.materials = new Set();
    this.size = null;
  }

  // positions: pairs of points in units of the scene, flat.
  make(positions, shade, width, opacity) {
    const shape = new THREE.LineSegmentsGeometry();
    shape.setPositions(positions.length ? positions : [0, 0, 0, 0, 0, 0]);
    const depthTest = width < 2.6;
    const material = new THREE.LineMaterial({
      color: shade,
      linewidth: width,
      transparent: true,
      opacity,
      depthTest,
    });
    if (this.size) material.resolution.set(...this.size);
    this.materials.add(material);
    const made = new THREE.LineSegments2(shape, material);
    made.renderOrder = 2;
    made.frustumCulled = false;
    return made;
  }

  forget(material) {
    this.materials.delete(material);
  }

  resize(width, height) {
    this.size = [width, height];
    for (const material of this.materials) material.resolution.set(width, height);
  }
}
