// SPDX-License-Identifier: Apache-2.0
#include "armature/analysis/wiring_graph.hpp"

#include <algorithm>
#include <set>
#include <unordered_map>
#include <utility>

#include "armature/analysis/wiring.hpp"
#include "armature/base/near_name.hpp"
#include "armature/component/author.hpp"
#include "armature/document/document.hpp"
#include "armature/document/ranges.hpp"

namespace armature::analysis {

using namespace document;
namespace {

constexpr std::size_t kNoThread = static_cast<std::size_t>(-1);

std::string activity_text(const exec::Activity& activity) {
  std::string text(exec::name_of(activity.kind));
  if (activity.kind == exec::Activity::Kind::kPeriodic) text += " " + to_text(activity.period);
  if (activity.scheduler == exec::Activity::Scheduler::kRealtime) {
    text += ", priority " + std::to_string(activity.priority);
  }
  if (activity.scheduler == exec::Activity::Scheduler::kDeadline) text += ", deadline";
  return text;
}

std::string type_text(const component::PortBase& port) {
  return port.type().name + (port.unit().empty() ? "" : " [" + std::string(port.unit()) + "]");
}

WiringEdge edge_of(const exec::ConnectionPlan& connection) {
  const component::ConnectionPolicy& policy = connection.entry->policy;
  WiringEdge edge{WiringEdge::Kind::kData,
                  connection.from,
                  connection.to,
                  connection.output->name(),
                  connection.input->name(),
                  connection.input->triggers(),
                  policy.one_cycle_delay,
                  {},
                  type_text(*connection.output)};
  const bool fifo = policy.kind == component::ConnectionPolicy::Kind::kFifo;
  if (fifo) edge.note = "fifo " + std::to_string(policy.capacity);
  if (policy.one_cycle_delay) edge.note = "one cycle later";
  return edge;
}

/// Peers of which nothing is used that has a name: they are used in another way.
void add_plain_peers(const exec::Blueprint& blueprint, Wiring& wiring) {
  std::unordered_map<std::string, std::size_t> index;
  std::set<std::pair<std::size_t, std::size_t>> shown;
  for (std::size_t i = 0; i < wiring.nodes.size(); ++i) index.emplace(wiring.nodes[i].name, i);
  for (const WiringEdge& edge : wiring.edges) {
    if (edge.kind == WiringEdge::Kind::kPeer) shown.emplace(edge.from, edge.to);
    if (edge.kind == WiringEdge::Kind::kEvent) shown.emplace(edge.to, edge.from);
  }
  for (std::size_t user = 0; user < blueprint.components.size(); ++user) {
    for (const exec::PeerEntry& peer : blueprint.components[user].peers) {
      const auto used = index.find(peer.name);
      if (used == index.end() || !shown.emplace(user, used->second).second) continue;
      wiring.edges.push_back(
          {WiringEdge::Kind::kPeer, user, used->second, {}, {}, false, false, {}, {}});
    }
  }
}

}  // namespace

Wiring make_wiring(const exec::Blueprint& blueprint, const exec::Plan& plan) {
  Wiring wiring;
  wiring.application = blueprint.name;
  std::vector<std::size_t> shown(plan.threads.size(), kNoThread);
  for (std::size_t t = 0; t < plan.threads.size(); ++t) {
    if (plan.threads[t].members.empty()) continue;
    shown[t] = wiring.threads.size();
    wiring.threads.push_back({plan.threads[t].name, activity_text(plan.threads[t].activity), {}});
  }
  for (std::size_t i = 0; i < blueprint.components.size(); ++i) {
    const exec::ComponentEntry& entry = blueprint.components[i];
    const std::size_t thread = shown[plan.thread_of[i]];
    wiring.threads[thread].nodes.push_back(i);
    wiring.nodes.push_back({entry.component->name(), entry.model, thread});
  }
  for (const exec::ConnectionPlan& connection : plan.connections) {
    wiring.edges.push_back(edge_of(connection));
  }
  for (const exec::SubscriptionPlan& told : plan.subscriptions) {
    wiring.edges.push_back({WiringEdge::Kind::kEvent,
                            told.from,
                            told.to,
                            std::string(told.event->name()),
                            std::string(told.handler->name()),
                            true,
                            false,
                            {},
                            {}});
  }
  for (const exec::CallPlan& call : plan.calls) {
    wiring.edges.push_back({WiringEdge::Kind::kPeer,
                            call.caller,
                            call.callee,
                            std::string(call.requirement->name()) + "()",
                            {},
                            false,
                            false,
                            {},
                            {}});
  }
  add_plain_peers(blueprint, wiring);
  return wiring;
}

std::string text_of(const Wiring& wiring, const WiringEdge& edge) {
  const auto end = [&](std::size_t node, const std::string& port) {
    return wiring.nodes[node].name + (port.empty() ? "" : "." + port);
  };
  std::string text = end(edge.from, edge.from_port) + " → " + end(edge.to, edge.to_port);
  if (edge.kind == WiringEdge::Kind::kPeer) text += ", peer";
  if (edge.kind == WiringEdge::Kind::kEvent) text += ", event";
  if (!edge.type.empty()) text += ", " + edge.type;
  if (edge.triggers && edge.kind == WiringEdge::Kind::kData) text += ", triggers";
  if (!edge.note.empty()) text += ", " + edge.note;
  return text;
}

Wiring make_wiring(const exec::Blueprint& blueprint, const exec::Plan& plan,
                   const GraphOptions& options) {
  Wiring wiring = make_wiring(blueprint, plan);
  if (!options.only.empty()) wiring = selection_of(wiring, options.only);
  return options.each_line ? wiring : bundled(wiring);
}

namespace {

std::string replaced(std::string_view text, const std::unordered_map<char, std::string>& by) {
  std::string result;
  for (const char c : text) {
    const auto found = by.find(c);
    result += found == by.end() ? std::string(1, c) : found->second;
  }
  return result;
}

std::string for_dot(std::string_view text) {
  return replaced(text, {{'"', "\\\""}, {'\\', "\\\\"}, {'\n', "\\n"}});
}

std::string for_mermaid(std::string_view text) {
  return replaced(text, {{'"', "#quot;"}, {'#', "#35;"}, {'<', "#lt;"}, {'>', "#gt;"}});
}

std::string id(std::size_t node) { return "c" + std::to_string(node); }

std::string label_of(const WiringEdge& edge) {
  std::string label = edge.from_port;
  if (!edge.to_port.empty() && edge.to_port != edge.from_port) label += " → " + edge.to_port;
  if (!edge.bundled.empty()) label += " × " + std::to_string(edge.bundled.size());
  if (!edge.note.empty()) label += " (" + edge.note + ")";
  return label;
}

std::string dot_edge(const WiringEdge& edge) {
  std::string attributes = "label=\"" + for_dot(label_of(edge)) + "\"";
  if (edge.kind == WiringEdge::Kind::kPeer) attributes += ", style=dashed, color=gray40";
  if (edge.kind == WiringEdge::Kind::kEvent) attributes += ", style=dotted, penwidth=2";
  if (edge.kind == WiringEdge::Kind::kData && edge.triggers) attributes += ", penwidth=2";
  if (edge.delayed) attributes += ", constraint=false";
  std::string list;
  for (const std::string& each : edge.bundled) list += (list.empty() ? "" : "\n") + each;
  if (!list.empty()) attributes += ", tooltip=\"" + for_dot(list) + "\"";
  return "  " + id(edge.from) + " -> " + id(edge.to) + " [" + attributes + "];\n";
}

std::string mermaid_edge(const WiringEdge& edge) {
  const bool dashed = edge.kind != WiringEdge::Kind::kData;
  const std::string arrow = dashed ? "-.->" : edge.triggers ? "==>" : "-->";
  const std::string label = for_mermaid(label_of(edge));
  std::string text = "  " + id(edge.from) + " " + arrow +
                     (label.empty() ? "" : "|\"" + label + "\"|") + " " + id(edge.to) + "\n";
  for (const std::string& each : edge.bundled) text += "  %% " + each + "\n";
  return text;
}

}  // namespace

base::Result<std::vector<std::string>> components_named(const std::string& text,
                                                        const exec::Blueprint& blueprint) {
  base::Diagnostics diagnostics;
  const auto range = find_range(text, {}, diagnostics);
  if (!diagnostics.ok()) return base::Error{"--only: " + diagnostics.all().front().message};
  std::vector<std::string> known;
  for (const exec::ComponentEntry& entry : blueprint.components) {
    known.push_back(entry.component->name());
  }
  std::vector<std::string> names;
  const auto [first, last] = range ? range->range : Range{1, 1};
  for (int number = first; number <= last; ++number) {
    const std::string name =
        range ? text.substr(0, range->begin) + std::to_string(number) + text.substr(range->end)
              : text;
    if (std::ranges::find(known, name) == known.end()) {
      return base::Error{"--only: unknown component '" + name + "'" +
                         base::suggestion_in_brackets(name, known)};
    }
    names.push_back(name);
  }
  return names;
}

std::string graph_as_dot(const exec::Blueprint& blueprint, const exec::Plan& plan,
                         const GraphOptions& options) {
  const Wiring wiring = make_wiring(blueprint, plan, options);
  std::string text = "digraph \"" + for_dot(wiring.application) +
                     "\" {\n"
                     "  rankdir=LR;\n"
                     "  node [shape=box, style=\"rounded,filled\", fillcolor=white, "
                     "fontname=\"sans-serif\"];\n"
                     "  edge [fontname=\"sans-serif\", fontsize=10];\n";
  for (std::size_t t = 0; t < wiring.threads.size(); ++t) {
    text += "  subgraph cluster_" + std::to_string(t) + " {\n    label=\"" +
            for_dot(wiring.threads[t].name + ": " + wiring.threads[t].activity) +
            "\";\n    style=\"rounded,filled\"; fillcolor=gray95; fontname=\"sans-serif\";\n";
    for (const std::size_t i : wiring.threads[t].nodes) {
      const WiringNode& node = wiring.nodes[i];
      text += "    " + id(i) + " [label=\"" + for_dot(node.name) + "\\n" + for_dot(node.model) +
              "\"];\n";
    }
    text += "  }\n";
  }
  for (const WiringEdge& edge : wiring.edges) text += dot_edge(edge);
  return text + "}\n";
}

std::string graph_as_mermaid(const exec::Blueprint& blueprint, const exec::Plan& plan,
                             const GraphOptions& options) {
  const Wiring wiring = make_wiring(blueprint, plan, options);
  std::string text = "flowchart LR\n";
  for (std::size_t t = 0; t < wiring.threads.size(); ++t) {
    text += "  subgraph t" + std::to_string(t) + "[\"" +
            for_mermaid(wiring.threads[t].name + ": " + wiring.threads[t].activity) + "\"]\n";
    for (const std::size_t i : wiring.threads[t].nodes) {
      const WiringNode& node = wiring.nodes[i];
      text += "    " + id(i) + "[\"<b>" + for_mermaid(node.name) + "</b><br>" +
              for_mermaid(node.model) + "\"]\n";
    }
    text += "  end\n";
  }
  for (const WiringEdge& edge : wiring.edges) text += mermaid_edge(edge);
  return text;
}

}  // namespace armature::analysis
