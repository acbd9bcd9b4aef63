// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>
#include <vector>

#include "armature/base/near_name.hpp"
#include "armature/component/interface.hpp"
#include "armature/component/operations/requirement.hpp"
#include "armature/exec/internal/wiring.hpp"

namespace armature::exec::internal {
namespace {

using component::Requirement;

/// One of a peer's operations or events, whichever is asked for.
template <typename Member>
struct Candidate {
  Index peer = kNone;
  Member* member = nullptr;
};

/// Why a peer's member cannot be used, empty if it can.
std::string why_not(const component::OperationBase& operation) {
  return operation.is_offered() ? "" : operation.why_not_offered();
}
std::string why_not(const component::EventBase& /*event*/) { return {}; }

class RequirementPlanner {
 public:
  RequirementPlanner(const Blueprint& blueprint, const Directory& directory, Plan& plan,
                     base::Diagnostics& diagnostics)
      : blueprint_(blueprint), directory_(directory), plan_(plan), diagnostics_(diagnostics) {}

  void run() {
    for (Index i = 0; i < blueprint_.components.size(); ++i) {
      const ComponentEntry& entry = blueprint_.components[i];
      find_peers(entry);
      check_bindings(entry);
      for (auto* caller : component::interface_of(*entry.component).callers)
        plan_call(i, entry, *caller);
      for (auto* handler : component::interface_of(*entry.component).handlers) {
        plan_subscription(i, entry, *handler);
      }
    }
  }

 private:
  void find_peers(const ComponentEntry& entry) {
    peers_.clear();
    peer_missing_ = false;
    for (const PeerEntry& peer : entry.peers) {
      const Index found = directory_.component(peer.name);
      peer_missing_ = peer_missing_ || found == kNone;
      if (found != kNone) {
        peers_.push_back(found);
      } else if (!is_absent(peer.name)) {
        diagnostics_.error(
            peer.where,
            quoted(entry.component->name()) + " has the unknown peer " + quoted(peer.name),
            base::suggestion(peer.name, directory_.component_names()));
      }
    }
  }

  void check_bindings(const ComponentEntry& entry) {
    std::vector<std::string> required;
    for (auto* caller : component::interface_of(*entry.component).callers)
      required.emplace_back(caller->name());
    for (auto* handler : component::interface_of(*entry.component).handlers) {
      required.emplace_back(handler->name());
    }
    for (const BindingEntry& binding : entry.bindings) {
      bool known = false;
      for (const std::string& name : required) known = known || name == binding.requirement;
      if (known) continue;
      diagnostics_.error(binding.where,
                         quoted(entry.component->name()) + " requires no operation or event " +
                             quoted(binding.requirement),
                         base::suggestion(binding.requirement, required));
    }
  }

  void plan_call(Index user, const ComponentEntry& entry, component::OperationCallerBase& caller) {
    if (!caller.wanted()) return;
    const auto [peer, operation] = find<component::OperationBase>(
        entry, caller, [](const component::Interface& i) -> const auto& { return i.operations; },
        "operation");
    if (operation == nullptr) return;
    if (!operation->signature().same_as(caller.signature()) ||
        operation->is_command() != caller.needs_command()) {
      diagnostics_.error(
          place(entry, caller),
          user_of(entry, caller) + " as " + caller.signature().text() +
              kind_text(caller.needs_command()) + ", but " +
              quoted(operation->owner().name() + "." + std::string(operation->name())) + " is " +
              operation->signature().text() + kind_text(operation->is_command()));
      return;
    }
    plan_.calls.push_back({user, peer, &caller, operation});
  }

  void plan_subscription(Index user, const ComponentEntry& entry,
                         component::EventHandlerBase& handler) {
    if (!handler.wanted()) return;
    const auto [peer, event] = find<component::EventBase>(
        entry, handler, [](const component::Interface& i) -> const auto& { return i.events; },
        "event");
    if (event == nullptr) return;
    if (!event->signature().same_as(handler.signature())) {
      diagnostics_.error(place(entry, handler),
                         user_of(entry, handler) + " as " + handler.signature().text() +
                             ", but the event " +
                             quoted(event->owner().name() + "." + std::string(event->name())) +
                             " is " + event->signature().text());
      return;
    }
    plan_.subscriptions.push_back({peer, user, event, &handler});
  }

  /// The peer's member that serves `requirement`: the bound one, or the only one of that name.
  template <typename Member, typename Members>
  Candidate<Member> find(const ComponentEntry& entry, const Requirement& requirement,
                         const Members& members, const std::string& kind) {
    if (const BindingEntry* binding = binding_of(entry, requirement)) {
      return find_bound<Member>(entry, requirement, *binding, members, kind);
    }
    const std::string wanted_peer = requirement.peer_name();
    if (!wanted_peer.empty() && !is_peer(entry, requirement, wanted_peer)) return {};
    std::vector<Candidate<Member>> found;
    std::string missing;
    for (const Index peer : peers_) {
      const component::Component& component = *blueprint_.components[peer].component;
      if (!wanted_peer.empty() && component.name() != wanted_peer) continue;
      for (Member* member : members(component::interface_of(component))) {
        if (member->name() != requirement.name()) continue;
        const std::string reason = why_not(*member);
        if (reason.empty()) {
          found.push_back({peer, member});
        } else {
          missing = reason;
        }
      }
    }
    if (found.size() == 1) return found.front();
    const bool needed = !requirement.is_optional() && !peer_missing_;
    if (found.empty() && needed) report_missing(entry, requirement, kind, missing);
    if (found.size() > 1) report_ambiguous(entry, requirement, kind, found);
    return {};
  }

  template <typename Member, typename Members>
  Candidate<Member> find_bound(const ComponentEntry& entry, const Requirement& requirement,
                               const BindingEntry& binding, const Members& members,
                               const std::string& kind) {
    if (is_absent(binding.peer)) return {};
    const Index peer = directory_.component(binding.peer);
    const bool declared = std::count(peers_.begin(), peers_.end(), peer) > 0;
    if (!declared && peer_missing_) return {};
    if (!declared) {
      diagnostics_.error(
          binding.where,
          quoted(binding.peer) + " is not a peer of " + quoted(entry.component->name()),
          "add it to the peers of " + quoted(entry.component->name()));
      return {};
    }
    const std::string& name = binding.member.empty() ? binding.requirement : binding.member;
    std::vector<std::string> names;
    for (Member* member :
         members(component::interface_of(*blueprint_.components[peer].component))) {
      if (member->name() == name) {
        const std::string missing = why_not(*member);
        if (missing.empty()) return {peer, member};
        diagnostics_.error(binding.where, user_of(entry, binding.requirement) + ": " + missing);
        return {};
      }
      names.emplace_back(member->name());
    }
    // Bound by the name that the component has for its peer, not by the deployment.
    if (binding.member.empty() && requirement.is_optional()) return {};
    diagnostics_.error(binding.where, quoted(binding.peer) + " has no " + kind + " " + quoted(name),
                       base::suggestion(name, names));
    return {};
  }

  const BindingEntry* binding_of(const ComponentEntry& entry, const Requirement& requirement) {
    for (const BindingEntry& binding : entry.bindings) {
      if (binding.requirement == requirement.name()) return &binding;
    }
    return nullptr;
  }

  bool is_absent(const std::string& name) const { return blueprint_.absent.count(name) > 0; }

  bool is_peer(const ComponentEntry& entry, const Requirement& requirement,
               const std::string& name) {
    for (const Index peer : peers_) {
      if (blueprint_.components[peer].component->name() == name) return true;
    }
    if (is_absent(name) || peer_missing_) return true;
    diagnostics_.error(
        entry.where,
        user_of(entry, requirement) + " of " + quoted(name) + ", which is not among its peers",
        "add it: peers: [" + name + "]");
    return false;
  }

  /// @param missing  why a peer has it and does not offer it, empty if none has it
  void report_missing(const ComponentEntry& entry, const Requirement& requirement,
                      const std::string& kind, const std::string& missing) {
    if (!missing.empty()) {
      return diagnostics_.error(entry.where, user_of(entry, requirement) + ": " + missing);
    }
    std::vector<std::string> who_has_it;
    for (const ComponentEntry& other : blueprint_.components) {
      const component::Interface& interface = component::interface_of(*other.component);
      for (const auto* operation : interface.operations) {
        if (operation->name() == requirement.name()) who_has_it.push_back(other.component->name());
      }
      for (const auto* event : interface.events) {
        if (event->name() == requirement.name()) who_has_it.push_back(other.component->name());
      }
      if (!who_has_it.empty()) break;
    }
    diagnostics_.error(entry.where, user_of(entry, requirement) + ": no peer has this " + kind,
                       who_has_it.empty()
                           ? "no component of the deployment has it"
                           : "add a peer that has it, for example " + quoted(who_has_it.front()));
  }

  template <typename Member>
  void report_ambiguous(const ComponentEntry& entry, const Requirement& requirement,
                        const std::string& kind, const std::vector<Candidate<Member>>& found) {
    const auto name = [&](const Candidate<Member>& candidate) {
      return blueprint_.components[candidate.peer].component->name();
    };
    diagnostics_.error(
        entry.where,
        user_of(entry, requirement) + ": several peers have this " + kind + ": " +
            quoted(name(found[0])) + ", " + quoted(name(found[1])),
        "choose one: bind: {" + std::string(requirement.name()) + ": " + name(found[0]) + "}");
  }

  base::Location place(const ComponentEntry& entry, const Requirement& requirement) {
    const BindingEntry* binding = binding_of(entry, requirement);
    return binding != nullptr ? binding->where : entry.where;
  }

  static std::string user_of(const ComponentEntry& entry, const Requirement& requirement) {
    return user_of(entry, std::string(requirement.name()));
  }
  static std::string user_of(const ComponentEntry& entry, const std::string& requirement) {
    return quoted(entry.component->name()) + " uses " + quoted(requirement);
  }
  static std::string kind_text(bool command) { return command ? " (a command)" : ""; }

  const Blueprint& blueprint_;
  const Directory& directory_;
  Plan& plan_;
  base::Diagnostics& diagnostics_;
  std::vector<Index> peers_;
  bool peer_missing_ = false;  ///< which was reported: what it would have served is not
};

}  // namespace

void plan_requirements(const Blueprint& blueprint, const Directory& directory, Plan& plan,
                       base::Diagnostics& diagnostics) {
  RequirementPlanner(blueprint, directory, plan, diagnostics).run();
}

}  // namespace armature::exec::internal
