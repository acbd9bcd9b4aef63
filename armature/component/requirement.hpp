// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "armature/component/component.hpp"
#include "armature/component/property.hpp"

namespace armature::component {

/// Options of what a component needs from a peer.
struct From {
  const Property<std::string>* peer;
};
/// The peer is the one that a property names; without this option it is the one peer that has it.
inline From from(const Property<std::string>& peer) { return {&peer}; }

struct Optional {};
/// It is no mistake if no peer has it.
inline constexpr Optional optional{};

struct Wanted {
  const Property<bool>* property;
};
/// Needed only while a property is true, e.g. brake operations only for a joint with a brake.
inline Wanted only_if(const Property<bool>& property) { return {&property}; }

/// Something that a component uses of a peer: an operation that it calls, an event it reacts to.
class Requirement {
 public:
  Requirement(const Requirement&) = delete;
  Requirement& operator=(const Requirement&) = delete;
  virtual ~Requirement() = default;

  std::string_view name() const { return name_; }
  std::string_view doc() const { return doc_; }
  Component& owner() const { return owner_; }
  bool is_optional() const { return optional_; }
  /// False if a property says that it is not needed.
  bool wanted() const { return wanted_ == nullptr || wanted_->get(); }
  /// The name of the peer that a property demands, empty if any peer will do.
  std::string peer_name() const { return peer_ == nullptr ? std::string() : peer_->get(); }
  virtual bool bound() const = 0;

 protected:
  Requirement(Component& owner, std::string_view name, std::string_view doc)
      : owner_(owner), name_(name), doc_(doc) {}

  void apply(From option) { peer_ = option.peer; }
  void apply(Optional) { optional_ = true; }
  void apply(Wanted option) { wanted_ = option.property; }

 private:
  Component& owner_;
  std::string_view name_;
  std::string_view doc_;
  const Property<std::string>* peer_ = nullptr;
  const Property<bool>* wanted_ = nullptr;
  bool optional_ = false;
};

}  // namespace armature::component
