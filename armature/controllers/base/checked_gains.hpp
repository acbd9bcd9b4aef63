// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "armature/component/author.hpp"
#include "armature/controllers/base/driven_joint.hpp"

namespace armature::controllers {

/// Gains that are judged by what they drive: when the deployment is checked, and from then on at
/// each change of one of their properties.
class CheckedGains final : public component::Checked, public component::PropertyFollower {
 public:
  /// Another value of one property; nullptr: all as they are.
  struct Wanted {
    const component::PropertyBase* property = nullptr;
    const void* data = nullptr;

    /// What the property would have then.
    template <typename T>
    const T& value_of(const component::Property<T>& of) const {
      return property == &of ? *static_cast<const T*>(data) : of.get();
    }
    template <typename Struct>
    Struct value_of(const component::Properties<Struct>& of) const {
      return of.with(property, data);
    }
  };
  using Find = std::function<std::vector<DrivenJoint>(const component::Check& check)>;
  /// What is wrong with the gains, for these joints; empty if nothing is.
  using Judge = std::function<std::string(const std::vector<DrivenJoint>& joints, double period_s,
                                          const Wanted& wanted)>;

  template <typename... Properties>
  CheckedGains(component::Component* owner, Find find, Judge judge, Properties&... properties)
      : Checked(owner), owner_(*owner), find_(std::move(find)), judge_(std::move(judge)) {
    (properties.add_follower(*this), ...);
  }

  void check(component::Check& check) const override;

  void follow() override {}
  std::string objection() const override { return {}; }
  std::string objection_to(const component::PropertyBase& property,
                           const types::Value& value) const override;

 private:
  component::Component& owner_;
  Find find_;
  Judge judge_;
  mutable std::vector<DrivenJoint> joints_;  ///< as the check found them
};

}  // namespace armature::controllers
