// SPDX-FileCopyrightText: 2026 The ofg authors
//
// SPDX-License-Identifier: MIT

// Included by kernels_body.hpp, once for each instruction set.

// The index of the point of each of two clouds that is least along an axis of its own.
template <class T>
static void extremes(const CloudView<T>& a, const T* axis_a, const CloudView<T>& b, const T* axis_b,
                     int* at) {
  least_product(a.x, a.y, a.z, a.n, axis_a, &at[0]);
  least_product(b.x, b.y, b.z, b.n, axis_b, &at[1]);
}
