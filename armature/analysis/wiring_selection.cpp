// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "armature/analysis/wiring.hpp"

namespace armature::analysis {
namespace {

constexpr std::size_t kLeftOut = static_cast<std::size_t>(-1);

}  // namespace

Wiring selection_of(const Wiring& wiring, const std::vector<std::string>& names) {
  std::vector<bool> named(wiring.nodes.size(), false);
  for (std::size_t i = 0; i < named.size(); ++i) {
    named[i] = std::ranges::find(names, wiring.nodes[i].name) != names.end();
  }
  std::vector<bool> shown = named;
  for (const WiringEdge& edge : wiring.edges) {
    if (named[edge.from]) shown[edge.to] = true;
    if (named[edge.to]) shown[edge.from] = true;
  }
  Wiring selection{wiring.application, {}, {}, {}};
  std::vector<std::size_t> place(wiring.nodes.size(), kLeftOut);
  for (const WiringThread& thread : wiring.threads) {
    std::vector<std::size_t> nodes;
    for (const std::size_t i : thread.nodes) {
      if (!shown[i]) continue;
      place[i] = selection.nodes.size();
      nodes.push_back(place[i]);
      selection.nodes.push_back(
          {wiring.nodes[i].name, wiring.nodes[i].model, selection.threads.size()});
    }
    if (!nodes.empty())
      selection.threads.push_back({thread.name, thread.activity, std::move(nodes)});
  }
  for (const WiringEdge& edge : wiring.edges) {
    if (!named[edge.from] && !named[edge.to]) continue;
    selection.edges.push_back(edge);
    selection.edges.back().from = place[edge.from];
    selection.edges.back().to = place[edge.to];
  }
  return selection;
}

}  // namespace armature::analysis
