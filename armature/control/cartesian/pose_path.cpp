// SPDX-License-Identifier: Apache-2.0
#include "armature/control/cartesian/pose_path.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace armature::control {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using RowMatrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

constexpr double kWayOfATurn = 0.1;    // m for each rad
constexpr double kNearest = 1e-6;      // m, of two places that are told apart
constexpr double kLeastTurn = 1e-6;    // rad, likewise
constexpr int kStepsOfACorner = 256;   // to know how long a parabola is
constexpr double kTurnsBack = -0.985;  // cosine of 170 degrees between two lines

struct Place {
  Vector3d position;
  Quaterniond turn;
};

Place place_of(const Pose& pose) {
  return {Vector3d(pose.position.data()),
          Quaterniond(Eigen::Map<const RowMatrix>(pose.rotation.data()))};
}

Pose pose_at(const Place& place) {
  Pose pose;
  Eigen::Map<Vector3d>(pose.position.data()) = place.position;
  Eigen::Map<RowMatrix>(pose.rotation.data()) = place.turn.normalized().toRotationMatrix();
  return pose;
}

bool is_finite(const Pose& pose) {
  const auto finite = [](double number) { return std::isfinite(number); };
  return std::ranges::all_of(pose.position, finite) && std::ranges::all_of(pose.rotation, finite);
}

double way_of(double distance, const Quaterniond& from, const Quaterniond& to) {
  return std::max(distance, kWayOfATurn * from.angularDistance(to));
}

/// From one place to another: the way, and the turn as a vector, 0.1 m for each rad.
struct Leap {
  Vector3d way;
  Vector3d turn;

  Leap(const Place& from, const Place& to) : way(to.position - from.position) {
    const Eigen::AngleAxisd turned(from.turn.inverse() * to.turn);
    turn = kWayOfATurn * turned.angle() * turned.axis();
  }
  double length() const { return std::hypot(way.norm(), turn.norm()); }
  double dot(const Leap& other) const { return way.dot(other.way) + turn.dot(other.turn); }
};

base::Error not_finite() { return base::Error{"a number of the pose is not finite"}; }

}  // namespace

/// One of its pieces.
class PosePath::Part {
 public:
  virtual ~Part() = default;
  double length() const { return length_; }
  double most_bend() const { return most_bend_; }  ///< [1/m]
  /// @param way  0..length()
  virtual Place at(double way) const = 0;

 protected:
  double length_ = 0.0;
  double most_bend_ = 0.0;
};

namespace {

class Line final : public PosePath::Part {
 public:
  Line(Place from, Place to) : from_(std::move(from)), to_(std::move(to)) {
    length_ = way_of((to_.position - from_.position).norm(), from_.turn, to_.turn);
  }
  Place at(double way) const override {
    const double share = way / length_;
    return {from_.position + share * (to_.position - from_.position),
            from_.turn.slerp(share, to_.turn)};
  }

 private:
  Place from_;
  Place to_;
};

class Arc final : public PosePath::Part {
 public:
  /// @param outward  from the centre to the begin; its length is the radius
  /// @param forward  of the same length, at the begin
  Arc(Vector3d centre, Vector3d outward, Vector3d forward, double angle, Quaterniond from,
      Quaterniond to)
      : centre_(std::move(centre)),
        outward_(std::move(outward)),
        forward_(std::move(forward)),
        angle_(angle),
        from_(from),
        to_(to) {
    length_ = way_of(angle * outward_.norm(), from, to);
    most_bend_ = outward_.norm() * angle / length_ * angle / length_;
  }
  Place at(double way) const override {
    const double share = way / length_;
    const double angle = share * angle_;
    return {centre_ + std::cos(angle) * outward_ + std::sin(angle) * forward_,
            from_.slerp(share, to_)};
  }

 private:
  Vector3d centre_;
  Vector3d outward_;
  Vector3d forward_;
  double angle_;
  Quaterniond from_;
  Quaterniond to_;
};

/// A parabola from one line to the next (de Casteljau's, of positions and of turns): it begins and
/// ends in their directions.
class Corner final : public PosePath::Part {
 public:
  Corner(Place from, Place corner, Place to)
      : from_(std::move(from)), corner_(std::move(corner)), to_(std::move(to)) {
    ways_.push_back(0.0);
    Place last = from_;
    for (int k = 1; k <= kStepsOfACorner; ++k) {
      Place next = at_share(static_cast<double>(k) / kStepsOfACorner);
      const double distance = (next.position - last.position).norm();
      ways_.push_back(ways_.back() + way_of(distance, last.turn, next.turn));
      last = std::move(next);
    }
    length_ = ways_.back();
    for (int k = 0; k <= kStepsOfACorner; ++k) {
      most_bend_ = std::max(most_bend_, bend_at(static_cast<double>(k) / kStepsOfACorner));
    }
  }
  Place at(double way) const override {
    const auto above = std::upper_bound(ways_.begin() + 1, ways_.end() - 1, way);
    const double begin = *(above - 1);
    const double within = *above > begin ? (way - begin) / (*above - begin) : 0.0;
    const double index = static_cast<double>(above - ways_.begin() - 1) + within;
    return at_share(std::clamp(index / kStepsOfACorner, 0.0, 1.0));
  }

 private:
  Place at_share(double share) const {
    const auto between = [share](const Place& left, const Place& right) {
      return Place{left.position + share * (right.position - left.position),
                   left.turn.slerp(share, right.turn)};
    };
    return between(between(from_, corner_), between(corner_, to_));
  }
  /// The second derivative by the way, of place or turn, of which the faster one is the way.
  double bend_at(double share) const {
    const Leap in(from_, corner_);
    const Leap out(corner_, to_);
    const auto slope = [&](const Vector3d Leap::*part) -> Vector3d {
      return 2.0 * ((1.0 - share) * in.*part + share * out.*part);
    };
    const auto curve = [&](const Vector3d Leap::*part) -> Vector3d {
      return 2.0 * (out.*part - in.*part);
    };
    const bool turns = slope(&Leap::turn).norm() > slope(&Leap::way).norm();
    const auto faster = turns ? &Leap::turn : &Leap::way;
    const double square = slope(faster).squaredNorm();
    const double drift = slope(faster).dot(curve(faster)) / square;
    const auto bend = [&](const Vector3d Leap::*part) {
      return (curve(part) - drift * slope(part)).norm() / square;
    };
    return std::max(bend(&Leap::way), bend(&Leap::turn));
  }

  Place from_;
  Place corner_;
  Place to_;
  std::vector<double> ways_;
};

/// At the second of three places; the path may turn back in its way, its turn, or in both.
bool turns_back(const Place& before, const Place& here, const Place& behind) {
  const Leap in(before, here);
  const Leap out(here, behind);
  return in.dot(out) < kTurnsBack * in.length() * out.length();
}

bool is_nothing(const Pose& from, const Pose& to) {
  const PoseDistance apart = distance(from, to);
  return apart.way < kNearest && apart.angle < kLeastTurn;
}

}  // namespace

Pose pose_of(const PoseNumbers& numbers) {
  const auto& [x, y, z, roll, pitch, yaw] = numbers;
  const Quaterniond turn = Eigen::AngleAxisd(yaw, Vector3d::UnitZ()) *
                           Eigen::AngleAxisd(pitch, Vector3d::UnitY()) *
                           Eigen::AngleAxisd(roll, Vector3d::UnitX());
  return pose_at({{x, y, z}, turn});
}

PoseNumbers numbers_of(const Pose& pose) {
  const auto& r = pose.rotation;
  const double level = std::hypot(r[0], r[3]);
  const double pitch = std::atan2(-r[6], level);
  constexpr double kUpright = 1e-9;  // roll and yaw turn about one axis: all of it is yaw
  const bool upright = level < kUpright;
  const double roll = upright ? 0.0 : std::atan2(r[7], r[8]);
  const double yaw = upright ? std::atan2(-r[1], r[4]) : std::atan2(r[3], r[0]);
  return {pose.position[0], pose.position[1], pose.position[2], roll, pitch, yaw};
}

PoseDistance distance(const Pose& left, const Pose& right) {
  const Place a = place_of(left);
  const Place b = place_of(right);
  return {(a.position - b.position).norm(), a.turn.angularDistance(b.turn)};
}

PosePath::PosePath(std::vector<std::shared_ptr<const Part>> parts) : parts_(std::move(parts)) {
  for (const auto& part : parts_) length_ += part->length();
}

base::Result<PosePath> PosePath::line(const Pose& from, const Pose& to) {
  return through(from, std::span(&to, 1), 0.0);
}

base::Result<PosePath> PosePath::arc(const Pose& from, const std::array<double, 3>& via,
                                     const Pose& to) {
  const Vector3d begin(from.position.data());
  const Vector3d middle(via.data());
  const Vector3d end(to.position.data());
  if (!is_finite(from) || !is_finite(to) || !middle.allFinite()) return not_finite();
  const Vector3d a = middle - begin;
  const Vector3d b = end - begin;
  const Vector3d axis = a.cross(b);
  if (axis.norm() < kNearest * std::max(a.norm(), b.norm()) || b.norm() < kNearest) {
    return base::Error{
        "its three places are on one line, or two of them are the same: expected three of a "
        "circle"};
  }
  // The centre of the circle around a triangle, seen from one of its corners.
  const Vector3d outward = (b.squaredNorm() * axis.cross(a) + a.squaredNorm() * b.cross(axis)) /
                           (2.0 * axis.squaredNorm());
  const Vector3d centre = begin + outward;
  const Vector3d first = begin - centre;
  const Vector3d forward = axis.normalized().cross(first);
  const Vector3d last = end - centre;
  double angle = std::atan2(last.dot(forward), last.dot(first));
  if (angle <= 0.0) angle += 2.0 * std::numbers::pi;
  const Place start = place_of(from);
  return PosePath(
      {std::make_shared<Arc>(centre, first, forward, angle, start.turn, place_of(to).turn)});
}

base::Result<PosePath> PosePath::through(const Pose& from, std::span<const Pose> poses,
                                         double blend) {
  if (poses.empty()) return base::Error{"there is no pose to go to"};
  if (poses.size() > 1 && !(blend > 0.0)) {
    return base::Error{"the blend is " + std::to_string(blend) +
                       " m, expected one above 0: the tool would have to stop at each corner"};
  }
  std::vector<Place> places{place_of(from)};
  const Pose* last = &from;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!is_finite(*last) || !is_finite(poses[i])) return not_finite();
    if (is_nothing(*last, poses[i])) {
      const std::string before =
          i == 0 ? "the path begins" : "pose " + std::to_string(i) + " is, the one before";
      return base::Error{"pose " + std::to_string(i + 1) + " is where " + before +
                         ": leave it out"};
    }
    places.push_back(place_of(poses[i]));
    last = &poses[i];
  }
  std::vector<std::shared_ptr<const Part>> parts;
  const auto add_line = [&](const Place& begin, const Place& end) {
    if (way_of((end.position - begin.position).norm(), begin.turn, end.turn) < kNearest) return;
    parts.push_back(std::make_shared<Line>(begin, end));
  };
  Place begin = places.front();
  for (std::size_t i = 1; i + 1 < places.size(); ++i) {
    if (turns_back(places[i - 1], places[i], places[i + 1])) {
      return base::Error{"at pose " + std::to_string(i) +
                         " the path turns back by more than 170 degrees: end one motion there, and "
                         "begin the next"};
    }
    const Line before(places[i - 1], places[i]);
    const Line behind(places[i], places[i + 1]);
    const double room = std::min({blend, 0.5 * before.length(), 0.5 * behind.length()});
    const Place entry = before.at(before.length() - room);
    const Place exit = behind.at(room);
    add_line(begin, entry);
    parts.push_back(std::make_shared<Corner>(entry, places[i], exit));
    begin = exit;
  }
  add_line(begin, places.back());
  return PosePath(std::move(parts));
}

double PosePath::bend(double from, double to) const {
  double most = 0.0;
  double begin = 0.0;
  for (const auto& part : parts_) {
    const double end = begin + part->length();
    if (begin <= to && end >= from) most = std::max(most, part->most_bend());
    begin = end;
  }
  return most;
}

Pose PosePath::at(double way) const {
  double left = std::clamp(way, 0.0, length_);
  for (const auto& part : parts_) {
    if (left <= part->length() || part == parts_.back()) {
      return pose_at(part->at(std::min(left, part->length())));
    }
    left -= part->length();
  }
  return {};
}

}  // namespace armature::control
