// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "armature/base/result.hpp"
#include "armature/component/by_operator.hpp"
#include "armature/component/component.hpp"
#include "armature/types/type.hpp"

namespace armature::component {

/// The smallest and largest value a number may have, both included.
struct Range {
  double low;
  double high;

  bool operator==(const Range&) const = default;
};

/// Options of a property, given behind its unit.
inline Range range(double low, double high) { return {low, high}; }
/// Option of a property: it may change while its component runs.
struct ChangeableWhileRunning {};
inline constexpr ChangeableWhileRunning changeable_while_running{};
/// Option of a property.
struct Mandatory {};
/// The property has no useful default: a deployment must give it.
inline constexpr Mandatory mandatory{};

/// Option of a property of numbers.
struct Sign {};
/// It is 1 or -1; whoever sets it may also say whether it inverts: true is -1, false is 1.
inline constexpr Sign sign{};

template <typename T>
class Property;

/// Option of a property or port, given in place of a unit that is known when the model is written:
/// another property of the component names it. Of components that serve any unit.
struct UnitOf {
  const Property<std::string>* property;
};
inline UnitOf unit_of(const Property<std::string>& property) { return {&property}; }

class Tap;
namespace internal {
class PropertyTap;
}  // namespace internal

class PropertyBase;

/// Something whose form follows from a property: ports whose number is the property's value.
class PropertyFollower {
 public:
  /// The property has a new value.
  virtual void follow() = 0;
  /// Why the property cannot change now, empty if it can.
  virtual std::string objection() const = 0;
  /// Why the property cannot have this value, empty if it can.
  virtual std::string objection_to(const PropertyBase& property, const types::Value& value) const;

 protected:
  ~PropertyFollower() = default;
};

/// A named value of a component: what tools, files and the deployment know of it.
class PropertyBase {
 public:
  PropertyBase(const PropertyBase&) = delete;
  PropertyBase& operator=(const PropertyBase&) = delete;
  virtual ~PropertyBase();

  std::string_view name() const { return about_->name; }
  std::string_view doc() const { return about_->doc; }
  /// Good as long as the property that names it, if one does, is not set anew.
  std::string_view unit() const;
  /// The property that names the unit; nullptr: the model says it.
  const Property<std::string>* unit_property() const { return about_->unit_property; }
  const types::Type& type() const { return about_->type; }
  Component& owner() const { return about_->owner; }
  /// False for an attribute, which no file keeps.
  bool persistent() const { return about_->persistent; }
  bool changeable() const { return about_->changeable; }
  bool is_mandatory() const { return about_->mandatory; }
  bool is_by_operator() const { return about_->by_operator; }
  /// It takes a boolean, too.
  bool is_sign() const { return about_->sign; }
  bool was_set() const { return about_->set; }
  const std::optional<Range>& limits() const { return about_->limits; }

  virtual const void* data() const = 0;

  /// What is wrong with `value` (of this property's type), empty if nothing.
  std::string check(const types::Value& value) const;

  /// Sets the value; refused outside the range, while the component runs unless changeable, and
  /// while ports that follow from it are connected.
  /// @thread the component's own; before the application runs, the one that builds it
  base::Result<void> set(const types::Value& value);

  /// Trades the value with `value`, which `check` accepted.
  /// @rt nonblocking, no allocation
  virtual void swap(types::Value& value) = 0;

  /// `follower` lives as long as the component.
  void add_follower(PropertyFollower& follower) { about_->followers.push_back(&follower); }

  /// Has the present value and every other that follows go to a tap, which lives until `untap`. Of
  /// a text or list it takes values of up to 256 bytes, or twice the present size; those that are
  /// longer count as dropped.
  /// @param capacity  values that it holds; of more the newest stay
  /// @thread configuration only
  Tap& tap(std::size_t capacity);
  void untap();

 protected:
  PropertyBase(Component& owner, std::string_view name, std::string_view doc, std::string_view unit,
               const types::Type& type, bool persistent) noexcept;

  void apply(Range limits) noexcept { about_->limits = limits; }
  void apply(ChangeableWhileRunning) noexcept { about_->changeable = true; }
  void apply(Mandatory) noexcept;
  void apply(ByOperator) noexcept { about_->by_operator = true; }
  void apply(Sign) noexcept { about_->sign = true; }
  void apply(UnitOf unit) noexcept { about_->unit_property = unit.property; }
  void tell_followers();

 private:
  std::string objection(const types::Value& value) const;

  /// All but the value lies apart: a loop that reads it reads little more.
  struct About {
    Component& owner;
    std::string_view name;
    std::string_view doc;
    std::string_view unit;
    const types::Type& type;
    bool persistent;
    bool changeable = false;
    bool mandatory = false;
    bool by_operator = false;
    bool sign = false;
    bool set = false;
    std::optional<Range> limits{};
    const Property<std::string>* unit_property = nullptr;
    std::vector<PropertyFollower*> followers{};
    std::vector<std::unique_ptr<internal::PropertyTap>> taps{};
  };
  std::unique_ptr<About> about_;
};

/// A configuration value that persists to files.
/// Names, documentation and units are literals: they must live as long as the component.
template <typename T>
class Property : public PropertyBase {
 public:
  template <typename... Options>
  Property(Component* owner, std::string_view name, std::type_identity_t<T> initial,
           std::string_view doc, std::string_view unit = {}, Options... options) noexcept
      : Property(*owner, name, std::move(initial), doc, unit, true) {
    (apply(options), ...);
  }
  ~Property() override;

  /// @rt nonblocking, no allocation
  /// @thread the component's own
  const T& get() const { return value_; }
  operator const T&() const { return value_; }  // NOLINT: reads like the value it is
  const T& operator()() const { return value_; }

  /// Changes the value from within the component.
  /// @thread the component's own
  void assign(const T& value) {
    value_ = value;
    tell_followers();
  }

  const void* data() const override;
  void swap(types::Value& value) override;

 protected:
  Property(Component& owner, std::string_view name, T&& initial, std::string_view doc,
           std::string_view unit, bool persistent) noexcept;

 private:
  T value_;
};

/// Like a property, but not kept in files.
template <typename T>
class Attribute final : public Property<T> {
 public:
  template <typename... Options>
  Attribute(Component* owner, std::string_view name, std::type_identity_t<T> initial,
            std::string_view doc, std::string_view unit = {}, Options... options) noexcept
      : Property<T>(*owner, name, std::move(initial), doc, unit, false) {
    (this->apply(options), ...);
  }
};

template <typename T>
Property<T>::Property(Component& owner, std::string_view name, T&& initial, std::string_view doc,
                      std::string_view unit, bool persistent) noexcept
    : PropertyBase(owner, name, doc, unit, types::type_of<T>(), persistent),
      value_(std::move(initial)) {}

template <typename T>
Property<T>::~Property() = default;

template <typename T>
const void* Property<T>::data() const {
  return &value_;
}

template <typename T>
void Property<T>::swap(types::Value& value) {
  std::swap(value_, *static_cast<T*>(value.data()));
}

// Compiled once, in the library.
extern template class Property<bool>;
extern template class Property<int>;
extern template class Property<double>;
extern template class Property<std::string>;
extern template class Property<std::vector<double>>;
extern template class Attribute<bool>;
extern template class Attribute<int>;
extern template class Attribute<double>;

}  // namespace armature::component
