// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>
#include <map>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include "armature/analysis/wiring.hpp"

namespace armature::analysis {
namespace {

/// `Joint12` is `Joint` and 12; a name without a number, or with one too long to count, has none.
struct NumberedName {
  std::string_view stem;
  std::optional<int> number;
};

NumberedName numbered(std::string_view name) {
  constexpr std::size_t kMostDigits = 9;
  std::size_t begin = name.size();
  while (begin > 0 && std::isdigit(static_cast<unsigned char>(name[begin - 1])) != 0) --begin;
  const std::string_view digits = name.substr(begin);
  const bool counts = !digits.empty() && digits.size() <= kMostDigits && begin > 0 &&
                      (digits.size() == 1 || digits.front() != '0');
  if (!counts) return {name, std::nullopt};
  return {name.substr(0, begin), std::stoi(std::string(digits))};
}

/// `1..3,7` of 1, 2, 3 and 7.
std::string ranges_text(std::vector<int> numbers) {
  std::ranges::sort(numbers);
  std::string text;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    text += (text.empty() ? "" : ",") + std::to_string(numbers[i]);
    if (last > i) text += ".." + std::to_string(numbers[last]);
    i = last + 1;
  }
  return text;
}

/// `Position1..7` for the names of seven ports; what does not fit beside a box is counted.
std::string names_text(const std::vector<std::string>& names) {
  constexpr std::size_t kRoom = 28;
  std::vector<std::string> texts;
  std::map<std::string_view, std::vector<int>> numbers;
  for (const std::string& name : names) {
    const NumberedName parts = numbered(name);
    if (!parts.number) {
      texts.push_back(name);
    } else {
      numbers[parts.stem].push_back(*parts.number);
    }
  }
  for (auto& [stem, those] : numbers) texts.push_back(std::string(stem) + ranges_text(those));
  std::string text;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (i > 0 && text.size() + texts[i].size() > kRoom) {
      return text + " +" + std::to_string(texts.size() - i);
    }
    text += (i > 0 ? ", " : "") + texts[i];
  }
  return text;
}

void add_once(const std::string& name, std::vector<std::string>& names) {
  if (!name.empty() && std::ranges::find(names, name) == names.end()) names.push_back(name);
}

/// Gathers the nodes of a wiring into fewer, then its edges.
class Bundling {
 public:
  explicit Bundling(const Wiring& wiring) : wiring_(wiring) {}

  Wiring run() {
    bundled_.application = wiring_.application;
    bundle_nodes();
    bundle_threads();
    for (const WiringEdge& edge : wiring_.edges) add(edge);
    for (Ends& ends : ends_) finish(ends);
    return std::move(bundled_);
  }

 private:
  /// What one edge stands for.
  struct Ends {
    std::size_t edge;
    std::vector<std::string> from_ports;
    std::vector<std::string> to_ports;
    std::vector<std::string> texts;
  };

  void bundle_nodes() {
    std::map<std::tuple<std::string_view, std::string_view, std::size_t>, std::size_t> known;
    std::vector<std::vector<int>> numbers;
    for (const WiringNode& node : wiring_.nodes) {
      const NumberedName name = numbered(node.name);
      const std::size_t next = bundled_.nodes.size();
      std::size_t place = next;
      if (name.number)
        place = known.try_emplace({name.stem, node.model, node.thread}, next).first->second;
      if (place == next) {
        bundled_.nodes.push_back(node);
        numbers.emplace_back();
      }
      if (name.number) numbers[place].push_back(*name.number);
      node_of_.push_back(place);
    }
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (numbers[i].size() < 2) continue;
      WiringNode& node = bundled_.nodes[i];
      node.name = std::string(numbered(node.name).stem) + ranges_text(numbers[i]);
      node.model = std::to_string(numbers[i].size()) + " × " + node.model;
    }
  }

  void bundle_threads() {
    bundled_.threads = wiring_.threads;
    for (WiringThread& thread : bundled_.threads) thread.nodes.clear();
    for (std::size_t i = 0; i < bundled_.nodes.size(); ++i) {
      bundled_.threads[bundled_.nodes[i].thread].nodes.push_back(i);
    }
  }

  void add(const WiringEdge& edge) {
    const std::size_t from = node_of_[edge.from];
    const std::size_t to = node_of_[edge.to];
    const Key key{from, to, edge.kind, edge.triggers, edge.delayed};
    const auto [found, fresh] = known_.try_emplace(key, ends_.size());
    if (fresh) {
      ends_.push_back({bundled_.edges.size(), {}, {}, {}});
      bundled_.edges.push_back(edge);
      bundled_.edges.back().from = from;
      bundled_.edges.back().to = to;
    }
    Ends& ends = ends_[found->second];
    WiringEdge& whole = bundled_.edges[ends.edge];
    if (whole.note != edge.note) whole.note.clear();
    if (whole.type != edge.type) whole.type.clear();
    add_once(edge.from_port, ends.from_ports);
    add_once(edge.to_port, ends.to_ports);
    ends.texts.push_back(text_of(wiring_, edge));
  }

  void finish(Ends& ends) {
    if (ends.texts.size() < 2) return;
    WiringEdge& edge = bundled_.edges[ends.edge];
    edge.from_port = names_text(ends.from_ports);
    edge.to_port = names_text(ends.to_ports);
    edge.bundled = std::move(ends.texts);
  }

  using Key = std::tuple<std::size_t, std::size_t, WiringEdge::Kind, bool, bool>;

  const Wiring& wiring_;
  Wiring bundled_;
  std::vector<std::size_t> node_of_;  ///< of each of the wiring's own
  std::map<Key, std::size_t> known_;
  std::vector<Ends> ends_;
};

}  // namespace

Wiring bundled(const Wiring& wiring) { return Bundling(wiring).run(); }

}  // namespace armature::analysis
