// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "armature/component/component.hpp"
#include "armature/component/properties/property.hpp"

namespace armature::component {

/// Options of what a component needs from a peer.
struct From {
  const Property<std::string>* peer;
};
/// The peer is the one that a property names; without this option it is the one peer that has it.
inline From from(const Property<std::string>& peer) { return {&peer}; }

/// Option of a requirement.
struct Optional {};
/// It is no mistake if no peer has it.
inline constexpr Optional optional{};

/// Option of a requirement, and of an operation.
struct Wanted {
  const Property<bool>* property;
};
/// Needed, or offered, only while a property is true, e.g. brake operations only for a joint with a
/// brake.
inline Wanted only_if(const Property<bool>& property) { return {&property}; }

/// Something that a component uses of a peer: an operation that it calls, an event it reacts to.
class Requirement : public Entrance {
 public:
  virtual ~Requirement();

  std::string_view name() const { return about_->name; }
  std::string_view doc() const { return about_->doc; }
  Component& owner() const { return owner_; }
  Component& component() const final { return owner_; }
  bool is_optional() const { return about_->optional; }
  /// False if a property says that it is not needed.
  bool wanted() const { return about_->wanted == nullptr || about_->wanted->get(); }
  /// The name of the peer that a property demands, empty if any peer will do.
  std::string peer_name() const;
  virtual bool bound() const = 0;

 protected:
  /// What is seldom needed lies apart, as for ports.
  struct About {
    About(std::string_view its_name, std::string_view its_doc) : name(its_name), doc(its_doc) {}
    virtual ~About();

    std::string_view name;
    std::string_view doc;
    const Property<std::string>* peer = nullptr;
    const Property<bool>* wanted = nullptr;
    bool optional = false;
  };

  Requirement(Component& owner, std::unique_ptr<About> about) noexcept;

  void apply(From option) noexcept { about_->peer = option.peer; }
  void apply(Optional) noexcept { about_->optional = true; }
  void apply(Wanted option) noexcept { about_->wanted = option.property; }

  About& about() const { return *about_; }

 private:
  Component& owner_;
  std::unique_ptr<About> about_;
};

}  // namespace armature::component
