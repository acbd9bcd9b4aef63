// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "armature/component/properties/property.hpp"

namespace armature::component {

/// A member of a struct as a property: made by `member`.
template <typename Struct, typename T, typename... Options>
struct Member {
  T Struct::*place;
  std::string_view name;
  std::string_view doc;
  std::string_view unit;
  std::tuple<Options...> options;
};

/// Gives a member of a struct its name and what else a Property has. Texts are literals.
///
///     member(&Config::kp, "Kp", "proportional gain", "V/rad", range(0.0, 10.0))
template <typename Struct, typename T, typename... Options>
Member<Struct, T, Options...> member(T Struct::*place, std::string_view name, std::string_view doc,
                                     std::string_view unit = {}, Options... options) {
  return {place, name, doc, unit, {options...}};
}

/// The properties of a component that are the members of a struct, such as the configuration of a
/// class of `control/`. Its code reads the struct; tools, files and the deployment see a property
/// for each member that is listed.
template <typename Struct>
class Properties {
 public:
  template <typename... Members>
  Properties(Component* owner, const Struct& initial, const Members&... members)
      : values_(initial) {
    members_.reserve(sizeof...(members));
    (members_.push_back(
         std::make_unique<One<decltype(Type::place_of(members))>>(*owner, values_, members)),
     ...);
  }
  Properties(const Properties&) = delete;
  Properties& operator=(const Properties&) = delete;

  /// @rt nonblocking, no allocation
  /// @thread the component's own
  const Struct& get() const { return values_; }
  const Struct* operator->() const { return &values_; }

  /// Adds a follower to each.
  void add_follower(PropertyFollower& follower) {
    for (const auto& each : members_) each->add_follower(follower);
  }

  /// The struct as it would be if one of its properties had another value; as it is for a property
  /// of somebody else.
  /// @param value  of the property's type
  Struct with(const PropertyBase* property, const void* value) const {
    Struct changed = values_;
    for (const auto& each : members_) {
      if (each.get() == property) each->put(value, changed);
    }
    return changed;
  }

 private:
  /// For the type of a member.
  struct Type {
    template <typename T, typename... Options>
    static T place_of(const Member<Struct, T, Options...>& member);
  };

  class OneOfThem : public PropertyBase {
   public:
    using PropertyBase::PropertyBase;
    virtual void put(const void* value, Struct& into) const = 0;
  };

  template <typename T>
  class One final : public OneOfThem {
   public:
    template <typename... Options>
    One(Component& owner, Struct& values, const Member<Struct, T, Options...>& member)
        : OneOfThem(owner, member.name, member.doc, member.unit, types::type_of<T>(), true),
          place_(member.place),
          value_(values.*member.place) {
      std::apply([this](const auto&... options) { (this->apply(options), ...); }, member.options);
    }

    const void* data() const override { return &value_; }
    void swap(types::Value& value) override { std::swap(value_, *static_cast<T*>(value.data())); }
    void put(const void* value, Struct& into) const override {
      into.*place_ = *static_cast<const T*>(value);
    }

   private:
    T Struct::*place_;
    T& value_;
  };

  Struct values_;
  std::vector<std::unique_ptr<OneOfThem>> members_;
};

}  // namespace armature::component
