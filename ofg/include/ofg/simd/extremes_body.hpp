// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Included by kernels_body.hpp, once for each instruction set.

// The point of each of two clouds that is least along an axis of its own: six numbers.
template <class T>
static void extremes(const CloudView<T>& a, const T* axis_a, const CloudView<T>& b, const T* axis_b,
                     T* points) {
  int i, j;
  least_product(a.x, a.y, a.z, a.n, axis_a, &i);
  least_product(b.x, b.y, b.z, b.n, axis_b, &j);
  points[0] = a.x[i], points[1] = a.y[i], points[2] = a.z[i];
  points[3] = b.x[j], points[4] = b.y[j], points[5] = b.z[j];
}
