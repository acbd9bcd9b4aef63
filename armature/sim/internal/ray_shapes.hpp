// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>

// Rays against shapes, in the axes of the shape. Compiled without fused multiplications: see
// RayCamera.
namespace armature::sim::internal {

struct Vector {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  friend Vector operator+(const Vector& a, const Vector& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend Vector operator-(const Vector& a, const Vector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend Vector operator*(double s, const Vector& a) { return {s * a.x, s * a.y, s * a.z}; }
};
inline double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Rows of a rotation.
using Matrix = std::array<Vector, 3>;
inline Vector operator*(const Matrix& m, const Vector& v) {
  return {dot(m[0], v), dot(m[1], v), dot(m[2], v)};
}
inline Matrix transposed(const Matrix& m) {
  return {Vector{m[0].x, m[1].x, m[2].x}, Vector{m[0].y, m[1].y, m[2].y},
          Vector{m[0].z, m[1].z, m[2].z}};
}
inline Matrix operator*(const Matrix& a, const Matrix& b) {
  const Matrix columns = transposed(b);
  const auto row = [&](const Vector& r) {
    return Vector{dot(r, columns[0]), dot(r, columns[1]), dot(r, columns[2])};
  };
  return {row(a[0]), row(a[1]), row(a[2])};
}

/// Where a ray meets a shape: `t` of the ray's direction from its origin, with the normal there.
struct Meeting {
  double t = 0.0;
  Vector normal;
  bool dark = false;  ///< a check
};

/// What is nearer is behind the lens.
constexpr double kNearest = 1e-3;

struct PlaneShape {
  double half_x;  ///< <= 0: without end
  double half_y;
  double check;  ///< size of a check; <= 0: none

  bool meet(const Vector& o, const Vector& d, double before, Meeting& meeting) const {
    if (!(d.z < 0.0)) return false;
    const double t = -o.z / d.z;
    if (!(t > kNearest && t < before)) return false;
    const double x = o.x + t * d.x;
    const double y = o.y + t * d.y;
    if (half_x > 0.0 && !(x >= -half_x && x <= half_x)) return false;
    if (half_y > 0.0 && !(y >= -half_y && y <= half_y)) return false;
    meeting.t = t;
    meeting.normal = {0.0, 0.0, 1.0};
    meeting.dark = check > 0.0 && is_dark(x, y);
    return true;
  }
  bool is_dark(double x, double y) const {
    constexpr double kAboveZero = 1048576.0;  // so that truncating is rounding down; even
    const auto column = static_cast<long long>(x / check + kAboveZero);
    const auto row = static_cast<long long>(y / check + kAboveZero);
    return ((column + row) & 1) != 0;
  }
};

struct SphereShape {
  double radius;

  bool meet(const Vector& o, const Vector& d, double before, Meeting& meeting) const {
    const double a = dot(d, d);
    const double b = dot(o, d);
    const double c = dot(o, o) - radius * radius;
    const double root = b * b - a * c;
    if (!(root >= 0.0)) return false;
    const double t = (-b - std::sqrt(root)) / a;
    if (!(t > kNearest && t < before)) return false;
    meeting.t = t;
    meeting.normal = (1.0 / radius) * (o + t * d);
    meeting.dark = false;
    return true;
  }
};

struct BoxShape {
  Vector half;

  bool meet(const Vector& o, const Vector& d, double before, Meeting& meeting) const {
    double enter = kNearest;
    double leave = before;
    Vector normal;
    const auto slab = [&](double from, double along, double reach, const Vector& axis) {
      if (along == 0.0) return from >= -reach && from <= reach;
      const double side = along > 0.0 ? -reach : reach;
      const double in = (side - from) / along;
      const double out = (-side - from) / along;
      if (in > enter) {
        enter = in;
        normal = (along > 0.0 ? -1.0 : 1.0) * axis;
      }
      if (out < leave) leave = out;
      return enter < leave;
    };
    if (!slab(o.x, d.x, half.x, {1.0, 0.0, 0.0}) || !slab(o.y, d.y, half.y, {0.0, 1.0, 0.0}) ||
        !slab(o.z, d.z, half.z, {0.0, 0.0, 1.0}) || enter == kNearest) {
      return false;
    }
    meeting = {enter, normal, false};
    return true;
  }
};

/// Upright: its axis is z.
struct CylinderShape {
  double radius;
  double half;

  bool meet(const Vector& o, const Vector& d, double before, Meeting& meeting) const {
    return meet_side(o, d, before, meeting) || meet_end(o, d, before, meeting);
  }
  bool meet_side(const Vector& o, const Vector& d, double before, Meeting& meeting) const {
    const double a = d.x * d.x + d.y * d.y;
    const double b = o.x * d.x + o.y * d.y;
    const double c = o.x * o.x + o.y * o.y - radius * radius;
    const double root = b * b - a * c;
    if (!(root >= 0.0) || a == 0.0) return false;
    const double t = (-b - std::sqrt(root)) / a;
    const double z = o.z + t * d.z;
    if (!(t > kNearest && t < before) || !(z >= -half && z <= half)) return false;
    meeting = {t, {(o.x + t * d.x) / radius, (o.y + t * d.y) / radius, 0.0}, false};
    return true;
  }
  bool meet_end(const Vector& o, const Vector& d, double before, Meeting& meeting) const {
    if (d.z == 0.0) return false;
    const double end = d.z < 0.0 ? half : -half;
    const double t = (end - o.z) / d.z;
    const double x = o.x + t * d.x;
    const double y = o.y + t * d.y;
    if (!(t > kNearest && t < before) || !(x * x + y * y <= radius * radius)) return false;
    meeting = {t, {0.0, 0.0, d.z < 0.0 ? 1.0 : -1.0}, false};
    return true;
  }
};

}  // namespace armature::sim::internal
