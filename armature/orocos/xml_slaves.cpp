// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "armature/base/near_name.hpp"
#include "armature/document/value_tree.hpp"
#include "armature/orocos/internal/xml_component.hpp"

namespace armature::orocos {

using namespace document;
namespace {

constexpr const char* kThread = "thread";

XmlElement* child_of(XmlElement& element, std::string_view name) {
  const auto found = std::find_if(element.children.begin(), element.children.end(),
                                  [&](const XmlElement& child) { return child.name == name; });
  return found == element.children.end() ? nullptr : &*found;
}

bool is_periodic(XmlElement& activity) {
  const XmlElement* const period = child_of(activity, "Period");
  const bool has_period =
      period != nullptr && period->text.find_first_of("123456789") != std::string::npos;
  return has_period && (activity.type == "PeriodicActivity" || activity.type == "Activity");
}

/// Gives slaves the activity of their masters.
class SlaveReader {
 public:
  SlaveReader(std::vector<XmlElement>& components, base::Diagnostics& diagnostics)
      : components_(components), diagnostics_(diagnostics) {
    for (XmlElement& component : components) by_name_.emplace(component.name, &component);
  }

  void run() {
    for (XmlElement& component : components_) {
      if (XmlElement* const activity = child_of(component, "Activity")) seat(component, *activity);
    }
  }

 private:
  void seat(const XmlElement& component, XmlElement& activity) {
    if (activity.type != "SlaveActivity") return;
    const std::string owner = "component " + in_quotes(component.name) + ": ";
    const XmlElement* const master = child_of(activity, "Master");
    if (master == nullptr) {
      diagnostics_.named_warning("slave_without_master", activity.where,
                                 owner +
                                     "a SlaveActivity without Master is read as a "
                                     "SequentialActivity: it runs when data or a call arrives");
      make_sequential(activity);
      return;
    }
    XmlElement* const leader = find_leader(owner, *master);
    if (leader == nullptr) return make_sequential(activity);
    XmlElement& its = *child_of(*leader, "Activity");
    share_thread(*leader, its);
    diagnostics_.note(activity.where, owner + "SlaveActivity is read as the activity of " +
                                          in_quotes(leader->name) +
                                          " in its thread, where writers run before readers");
    XmlElement copy = its;
    copy.where = activity.where;
    activity = std::move(copy);
  }

  /// The master that is no slave itself; nullptr and an error if there is none that is periodic.
  XmlElement* find_leader(const std::string& owner, const XmlElement& master) {
    const XmlElement* named = &master;
    for (std::size_t steps = 0; steps <= components_.size(); ++steps) {
      XmlElement* const leader = find(named->text);
      if (leader == nullptr) {
        refuse(master,
               owner + "its Master " + in_quotes(named->text) + " is not a component of this file");
        return nullptr;
      }
      XmlElement* const activity = child_of(*leader, "Activity");
      if (activity != nullptr && activity->type == "SlaveActivity") {
        named = child_of(*activity, "Master");
        if (named != nullptr) continue;
      }
      if (activity != nullptr && is_periodic(*activity)) return leader;
      refuse(master, owner + "its Master " + in_quotes(leader->name) +
                         " is not periodic, so the slave has no period");
      return nullptr;
    }
    refuse(master, owner + "it is its own Master");
    return nullptr;
  }

  void refuse(const XmlElement& master, const std::string& message) {
    std::vector<std::string> names;
    for (const XmlElement& component : components_) names.push_back(component.name);
    const std::string near =
        find(master.text) == nullptr ? base::near_name(master.text, names) : "";
    diagnostics_.error(master.where, message,
                       near.empty() ? "give it an activity of its own, as SequentialActivity"
                                    : "did you mean '" + near + "'?");
  }

  XmlElement* find(std::string_view name) const {
    const auto found = by_name_.find(name);
    return found == by_name_.end() ? nullptr : found->second;
  }

  static void make_sequential(XmlElement& activity) {
    activity.type = "SequentialActivity";
    activity.children.clear();
  }

  static void share_thread(const XmlElement& leader, XmlElement& activity) {
    const bool named = std::any_of(activity.extras.begin(), activity.extras.end(),
                                   [](const auto& extra) { return extra.first == kThread; });
    if (named) return;
    std::string thread = leader.name + "_thread";
    std::replace(thread.begin(), thread.end(), '.', '_');
    activity.extras.emplace_back(kThread, std::move(thread));
  }

  std::vector<XmlElement>& components_;
  base::Diagnostics& diagnostics_;
  std::unordered_map<std::string_view, XmlElement*> by_name_;
};

}  // namespace

void seat_slaves(std::vector<XmlElement>& components, base::Diagnostics& diagnostics) {
  SlaveReader(components, diagnostics).run();
}

}  // namespace armature::orocos
