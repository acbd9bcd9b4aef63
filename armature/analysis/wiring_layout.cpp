// SPDX-License-Identifier: Apache-2.0
#include "armature/analysis/wiring_layout.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "armature/base/utf8.hpp"

namespace armature::analysis {

using namespace document;
namespace {

constexpr double kLetterWidth = 6.8;
constexpr double kBoxPadding = 10.0;
constexpr double kLayerGap = 90.0;
constexpr double kItemGap = 18.0;
constexpr double kPassHeight = 6.0;
constexpr int kSweeps = 6;

/// Something that takes place in a layer: a component, or an edge on its way through.
struct Item {
  std::size_t layer = 0;
  std::size_t lane = 0;
  double height = kPassHeight;
  double y = 0.0;      ///< of its upper side, from the lane's
  double order = 0.0;  ///< place in its layer
};

/// Two items in neighbouring layers that an edge joins, and where at them it ends.
struct Link {
  std::size_t left;
  std::size_t right;
  double left_y;  ///< from the item's upper side
  double right_y;
};

double row_y(std::size_t row) {
  return kHeaderHeight + (static_cast<double>(row) + 0.5) * kRowHeight;
}

class Placer {
 public:
  explicit Placer(const Wiring& wiring) : wiring_(wiring) {
    layout_.boxes.resize(wiring.nodes.size());
    layout_.ways.resize(wiring.edges.size());
    layout_.lanes.resize(wiring.threads.size());
  }

  WiringLayout run() {
    make_boxes();
    find_layers();
    make_items();
    order_items();
    stack_items();
    for (int sweep = 0; sweep < kSweeps; ++sweep) straighten(sweep % 2 == 0);
    place_boxes();
    draw_ways();
    return std::move(layout_);
  }

 private:
  static constexpr double kPeerRow = kHeaderHeight / 2.0;

  void make_boxes() {
    ends_.resize(wiring_.edges.size());
    std::vector<std::unordered_map<std::string, std::size_t>> left(wiring_.nodes.size());
    std::vector<std::unordered_map<std::string, std::size_t>> right(wiring_.nodes.size());
    const auto row = [](auto& known, std::vector<std::string>& rows, const std::string& port) {
      const auto [entry, fresh] = known.emplace(port, rows.size());
      if (fresh) rows.push_back(port);
      return row_y(entry->second);
    };
    for (std::size_t e = 0; e < wiring_.edges.size(); ++e) {
      const WiringEdge& edge = wiring_.edges[e];
      const bool from_header = edge.from_port.empty();
      const bool to_header = edge.to_port.empty();
      ends_[e].first = from_header
                           ? kPeerRow
                           : row(right[edge.from], layout_.boxes[edge.from].right, edge.from_port);
      ends_[e].second =
          to_header ? kPeerRow : row(left[edge.to], layout_.boxes[edge.to].left, edge.to_port);
    }
    for (std::size_t i = 0; i < layout_.boxes.size(); ++i) measure(i);
  }

  void measure(std::size_t i) {
    Box& box = layout_.boxes[i];
    double left = 0.0;
    double right = 0.0;
    for (const std::string& port : box.left) left = std::max(left, text_width(port));
    for (const std::string& port : box.right) right = std::max(right, text_width(port));
    const double header =
        std::max(text_width(wiring_.nodes[i].name) * 1.1, text_width(wiring_.nodes[i].model));
    box.width = std::max(header, left + right + kBoxPadding) + 2.0 * kBoxPadding;
    const auto rows = static_cast<double>(std::max(box.left.size(), box.right.size()));
    box.height = kHeaderHeight + rows * kRowHeight + (rows > 0 ? kBoxPadding / 2.0 : 0.0);
  }

  /// Each component comes one layer after the last of those whose data it uses; where they form a
  /// circle, the one declared first begins it.
  void find_layers() {
    const std::size_t count = wiring_.nodes.size();
    std::vector<std::vector<std::size_t>> after(count);
    std::vector<std::size_t> waits(count, 0);
    for (const WiringEdge& edge : wiring_.edges) {
      if (edge.delayed || edge.from == edge.to) continue;
      after[edge.from].push_back(edge.to);
      ++waits[edge.to];
    }
    layer_.assign(count, 0);
    std::vector<bool> done(count, false);
    std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> ready;
    for (std::size_t i = 0; i < count; ++i) {
      if (waits[i] == 0) ready.push(i);
    }
    std::size_t first_open = 0;
    for (std::size_t placed = 0; placed < count;) {
      while (first_open < count && done[first_open]) ++first_open;
      if (ready.empty()) ready.push(first_open);
      const std::size_t next = ready.top();
      ready.pop();
      if (done[next]) continue;
      done[next] = true;
      ++placed;
      for (const std::size_t later : after[next]) {
        if (done[later]) continue;
        layer_[later] = std::max(layer_[later], layer_[next] + 1);
        if (--waits[later] == 0) ready.push(later);
      }
    }
    pull_sources(after);
  }

  /// What nobody feeds stands right before the first that it feeds.
  void pull_sources(const std::vector<std::vector<std::size_t>>& after) {
    std::vector<bool> fed(layer_.size(), false);
    for (const auto& all : after) {
      for (const std::size_t to : all) fed[to] = true;
    }
    for (std::size_t i = 0; i < layer_.size(); ++i) {
      if (fed[i] || after[i].empty()) continue;
      std::size_t first = layer_[after[i].front()];
      for (const std::size_t to : after[i]) first = std::min(first, layer_[to]);
      if (first > 0) layer_[i] = first - 1;
    }
    for (const std::size_t layer : layer_) layers_ = std::max(layers_, layer + 1);
  }

  void make_items() {
    for (std::size_t i = 0; i < wiring_.nodes.size(); ++i) {
      items_.push_back({layer_[i], wiring_.nodes[i].thread, layout_.boxes[i].height});
    }
    chains_.resize(wiring_.edges.size());
    for (std::size_t e = 0; e < wiring_.edges.size(); ++e) chain(e);
    columns_.assign(layers_, std::vector<std::vector<std::size_t>>(wiring_.threads.size()));
    for (std::size_t i = 0; i < items_.size(); ++i) {
      columns_[items_[i].layer][items_[i].lane].push_back(i);
    }
    left_of_.resize(items_.size());
    right_of_.resize(items_.size());
    for (std::size_t l = 0; l < links_.size(); ++l) {
      left_of_[links_[l].right].push_back(l);
      right_of_[links_[l].left].push_back(l);
    }
  }

  /// The items of an edge: passes through the layers between its ends; an edge against the flow
  /// also passes beside both ends.
  void chain(std::size_t e) {
    const WiringEdge& edge = wiring_.edges[e];
    const std::size_t from = layer_[edge.from];
    const std::size_t to = layer_[edge.to];
    const bool backward = to <= from;
    layout_.ways[e].backward = backward;
    std::vector<std::size_t>& items = chains_[e];
    const std::size_t lane = wiring_.nodes[backward ? edge.to : edge.from].thread;
    const std::size_t first = backward ? to : from + 1;
    const std::size_t last = backward ? from + 1 : to;
    for (std::size_t layer = first; layer < last; ++layer) {
      items.push_back(items_.size());
      items_.push_back({layer, lane, kPassHeight});
    }
    std::size_t before = backward ? items.front() : edge.from;
    double before_y = backward ? kPassHeight / 2.0 : ends_[e].first;
    for (std::size_t i = backward ? 1 : 0; i < items.size(); ++i) {
      links_.push_back({before, items[i], before_y, kPassHeight / 2.0});
      before = items[i];
      before_y = kPassHeight / 2.0;
    }
    if (!backward) links_.push_back({before, edge.to, before_y, ends_[e].second});
  }

  void order_items() {
    for (auto& column : columns_) {
      for (auto& lane : column) {
        for (std::size_t i = 0; i < lane.size(); ++i) {
          items_[lane[i]].order = static_cast<double>(i);
        }
      }
    }
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      const bool forward = sweep % 2 == 0;
      for (std::size_t i = 0; i < layers_; ++i) {
        order_column(columns_[forward ? i : layers_ - 1 - i], forward);
      }
    }
  }

  /// By the mean place of what each item is linked to in the column before.
  void order_column(std::vector<std::vector<std::size_t>>& column, bool forward) {
    for (auto& lane : column) {
      std::vector<std::pair<double, std::size_t>> wanted;
      for (const std::size_t item : lane) wanted.emplace_back(mean_order(item, forward), item);
      std::stable_sort(wanted.begin(), wanted.end(),
                       [](const auto& a, const auto& b) { return a.first < b.first; });
      for (std::size_t i = 0; i < lane.size(); ++i) {
        lane[i] = wanted[i].second;
        items_[lane[i]].order = static_cast<double>(i);
      }
    }
  }

  double mean_order(std::size_t item, bool forward) const {
    const auto& links = forward ? left_of_[item] : right_of_[item];
    double sum = 0.0;
    std::size_t count = 0;
    for (const std::size_t l : links) {
      const Link& link = links_[l];
      const Item& other = items_[forward ? link.left : link.right];
      if (other.lane != items_[item].lane) continue;
      const double y = forward ? link.left_y : link.right_y;
      sum += other.order + y / (other.height + 1.0);
      ++count;
    }
    return count == 0 ? items_[item].order : sum / static_cast<double>(count);
  }

  void stack_items() {
    lane_heights_.assign(wiring_.threads.size(), 0.0);
    for (auto& column : columns_) {
      for (std::size_t lane = 0; lane < column.size(); ++lane) {
        double y = 0.0;
        for (const std::size_t item : column[lane]) {
          items_[item].y = y;
          y += items_[item].height + kItemGap;
        }
        lane_heights_[lane] = std::max(lane_heights_[lane], y - kItemGap);
      }
    }
  }

  /// Moves items to where their edges run straight, as far as order and lane allow.
  void straighten(bool forward) {
    for (std::size_t i = 0; i < layers_; ++i) {
      auto& column = columns_[forward ? i : layers_ - 1 - i];
      for (std::size_t lane = 0; lane < column.size(); ++lane) {
        settle(column[lane], lane_heights_[lane], forward);
      }
    }
  }

  void settle(const std::vector<std::size_t>& items, double height, bool forward) {
    double least = 0.0;
    for (const std::size_t item : items) {
      items_[item].y = std::max(least, wanted_y(item, forward));
      least = items_[item].y + items_[item].height + kItemGap;
    }
    double most = height;
    for (auto item = items.rbegin(); item != items.rend(); ++item) {
      Item& one = items_[*item];
      one.y = std::min(one.y, most - one.height);
      most = one.y - kItemGap;
    }
  }

  double wanted_y(std::size_t item, bool forward) const {
    const auto& links = forward ? left_of_[item] : right_of_[item];
    double sum = 0.0;
    std::size_t count = 0;
    for (const std::size_t l : links) {
      const Link& link = links_[l];
      const Item& other = items_[forward ? link.left : link.right];
      if (other.lane != items_[item].lane) continue;
      sum += forward ? other.y + link.left_y - link.right_y : other.y + link.right_y - link.left_y;
      ++count;
    }
    return count == 0 ? items_[item].y : sum / static_cast<double>(count);
  }

  void place_boxes() {
    double y = kMargin;
    for (std::size_t lane = 0; lane < layout_.lanes.size(); ++lane) {
      const double height = kLaneTitleHeight + lane_heights_[lane] + kMargin;
      layout_.lanes[lane] = {y, height};
      y += height + kMargin;
    }
    layout_.height = y;
    std::vector<double> widths(layers_, 0.0);
    for (std::size_t i = 0; i < layout_.boxes.size(); ++i) {
      widths[layer_[i]] = std::max(widths[layer_[i]], layout_.boxes[i].width);
    }
    column_x_.assign(layers_ + 1, kMargin + kLayerGap / 2.0);
    for (std::size_t i = 0; i < layers_; ++i) {
      column_x_[i + 1] = column_x_[i] + widths[i] + kLayerGap;
    }
    layout_.width = column_x_[layers_] - kLayerGap / 2.0 + kMargin;
    for (std::size_t i = 0; i < layout_.boxes.size(); ++i) {
      Box& box = layout_.boxes[i];
      box.width = widths[layer_[i]];
      box.x = column_x_[layer_[i]];
      box.y = top_of(items_[i]);
    }
  }

  double top_of(const Item& item) const {
    return layout_.lanes[item.lane].y + kLaneTitleHeight + item.y;
  }

  void draw_ways() {
    for (std::size_t e = 0; e < wiring_.edges.size(); ++e) {
      const WiringEdge& edge = wiring_.edges[e];
      const Box& from = layout_.boxes[edge.from];
      const Box& to = layout_.boxes[edge.to];
      Way& way = layout_.ways[e];
      way.points.push_back({from.x + from.width, from.y + ends_[e].first});
      std::vector<std::size_t> items = chains_[e];
      if (way.backward) std::reverse(items.begin(), items.end());
      for (const std::size_t item : items) add_pass(items_[item], way);
      way.points.push_back({to.x, to.y + ends_[e].second});
    }
  }

  /// Straight through the layer, so that boxes there are not crossed.
  void add_pass(const Item& item, Way& way) const {
    const double y = top_of(item) + kPassHeight / 2.0;
    const double left = column_x_[item.layer];
    const double right = column_x_[item.layer + 1] - kLayerGap;
    way.points.push_back({way.backward ? right : left, y});
    way.points.push_back({way.backward ? left : right, y});
  }

  const Wiring& wiring_;
  WiringLayout layout_;
  std::vector<std::pair<double, double>> ends_;  ///< of each edge: y in its boxes
  std::vector<std::size_t> layer_;               ///< of each node
  std::size_t layers_ = 1;
  std::vector<Item> items_;  ///< the nodes first
  std::vector<std::vector<std::size_t>> chains_;
  std::vector<Link> links_;
  std::vector<std::vector<std::size_t>> left_of_;  ///< links of each item
  std::vector<std::vector<std::size_t>> right_of_;
  std::vector<std::vector<std::vector<std::size_t>>> columns_;  ///< layer, lane: items from above
  std::vector<double> lane_heights_;
  std::vector<double> column_x_;
};

}  // namespace

WiringLayout place(const Wiring& wiring) { return Placer(wiring).run(); }

double text_width(std::string_view text) {
  return kLetterWidth * static_cast<double>(base::character_count(text));
}

}  // namespace armature::analysis
