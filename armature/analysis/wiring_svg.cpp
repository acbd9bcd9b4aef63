// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>

#include "armature/analysis/wiring_graph.hpp"
#include "armature/analysis/wiring_layout.hpp"
#include "armature/base/xml_text.hpp"

namespace armature::analysis {

namespace {

constexpr double kBend = 40.0;
constexpr double kTextBaseline = 4.0;
constexpr double kPortText = 7.0;
constexpr double kLegendWidth = 500.0;
constexpr double kLegendHeight = 24.0;

constexpr std::string_view kStyle = R"(<style>
  text { font-family: "DejaVu Sans", "Segoe UI", Helvetica, Arial, sans-serif; font-size: 12px; fill: #1d2733; }
  .page { fill: #ffffff; }
  .lane { fill: #f3f6fa; stroke: #c9d4e0; }
  .lane-title { font-weight: bold; fill: #47617d; }
  .lane-activity { font-weight: normal; fill: #6d8299; }
  .box { fill: #ffffff; stroke: #5b7690; stroke-width: 1.2; }
  .head { fill: #dfe9f4; stroke: #5b7690; stroke-width: 1.2; }
  .name { font-weight: bold; font-size: 13px; }
  .model { font-size: 11px; fill: #5b6f84; }
  .port { font-size: 11px; }
  .use { font-size: 11px; fill: #6d6d6d; font-style: italic; }
  .note { font-size: 10px; fill: #8a4b08; stroke: #ffffff; stroke-width: 3px; paint-order: stroke; }
  .data { fill: none; stroke: #34648f; stroke-width: 1.3; }
  .trigger { fill: none; stroke: #c05621; stroke-width: 2; }
  .event { fill: none; stroke: #c05621; stroke-width: 1.6; stroke-dasharray: 2 3; }
  .peer { fill: none; stroke: #8a8a8a; stroke-width: 1.2; stroke-dasharray: 6 4; }
  .data:hover, .trigger:hover, .event:hover, .peer:hover { stroke-width: 4; }
</style>
<defs>
  <marker id="data" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="8" markerHeight="8" markerUnits="userSpaceOnUse" orient="auto"><path d="M0 0 8 4 0 8z" fill="#34648f"/></marker>
  <marker id="trigger" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="10" markerHeight="10" markerUnits="userSpaceOnUse" orient="auto"><path d="M0 0 8 4 0 8z" fill="#c05621"/></marker>
  <marker id="peer" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="8" markerHeight="8" markerUnits="userSpaceOnUse" orient="auto"><path d="M0 0 8 4 0 8 2 4z" fill="#8a8a8a"/></marker>
</defs>
)";

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f", value);
  return text.data();
}

std::string rectangle(std::string_view style, double x, double y, double width, double height,
                      double radius) {
  return "<rect class=\"" + std::string(style) + "\" x=\"" + number(x) + "\" y=\"" + number(y) +
         "\" width=\"" + number(width) + "\" height=\"" + number(height) + "\" rx=\"" +
         number(radius) + "\"/>\n";
}

std::string label(std::string_view style, std::string_view anchor, Point at,
                  std::string_view text) {
  return "<text class=\"" + std::string(style) + "\" text-anchor=\"" + std::string(anchor) +
         "\" x=\"" + number(at.x) + "\" y=\"" + number(at.y + kTextBaseline) + "\">" +
         base::xml_escaped(text) + "</text>\n";
}

std::string point(Point at) { return number(at.x) + " " + number(at.y); }

/// From `a` to `b`, horizontal at both, in the directions given (1: to the right).
std::string bend(Point a, double leaves, Point b, double arrives) {
  const bool turns = leaves != arrives;
  const double reach = turns ? kBend : std::max(kBend / 2.0, std::abs(b.x - a.x) / 2.0);
  return " C" + point({a.x + leaves * reach, a.y}) + " " + point({b.x - arrives * reach, b.y}) +
         " " + point(b);
}

/// Points come in pairs: a bend to each odd one, straight from there to the next.
std::string path_of(const Way& way) {
  std::string path = "M" + point(way.points[0]);
  const double middle = way.backward ? -1.0 : 1.0;
  const std::size_t count = way.points.size();
  for (std::size_t i = 1; i < count; i += 2) {
    const double leaves = i == 1 ? 1.0 : middle;
    const double arrives = i + 1 == count ? 1.0 : middle;
    path += bend(way.points[i - 1], leaves, way.points[i], arrives);
    if (i + 1 < count) path += " L" + point(way.points[i + 1]);
  }
  return path;
}

std::string_view style_of(const WiringEdge& edge) {
  if (edge.kind == WiringEdge::Kind::kPeer) return "peer";
  if (edge.kind == WiringEdge::Kind::kEvent) return "event";
  return edge.triggers ? "trigger" : "data";
}

/// What a pointer that rests on the line is shown.
std::string title_of(const Wiring& wiring, const WiringEdge& edge) {
  if (edge.bundled.empty()) return text_of(wiring, edge);
  std::string title = std::to_string(edge.bundled.size()) + " connections:";
  for (const std::string& each : edge.bundled) title += '\n' + each;
  return title;
}

/// `7 ×, fifo 8`.
std::string note_of(const WiringEdge& edge) {
  if (edge.bundled.empty()) return edge.note;
  const std::string count = std::to_string(edge.bundled.size()) + " ×";
  return edge.note.empty() ? count : count + ", " + edge.note;
}

std::string draw_edge(const Wiring& wiring, const WiringEdge& edge, const Way& way) {
  const std::string_view style = style_of(edge);
  const std::string_view marker = style == "event" ? "trigger" : style;
  return "<path class=\"" + std::string(style) + "\" marker-end=\"url(#" + std::string(marker) +
         ")\" d=\"" + path_of(way) + "\"><title>" + base::xml_escaped(title_of(wiring, edge)) +
         "</title></path>\n";
}

/// Above the beginning of the line.
std::string draw_note(const WiringEdge& edge, const Way& way) {
  const std::string note = note_of(edge);
  if (note.empty()) return {};
  const Point at = way.points.front();
  return label("note", "start", {at.x + kPortText, at.y - kPortText}, note);
}

double row_y(const Box& box, std::size_t row) {
  return box.y + kHeaderHeight + (static_cast<double>(row) + 0.5) * kRowHeight;
}

std::string draw_box(const WiringNode& node, const Box& box) {
  constexpr double kRadius = 5.0;
  constexpr double kNameLine = 14.0;
  constexpr double kModelLine = 29.0;
  const double middle = box.x + box.width / 2.0;
  std::string text = rectangle("box", box.x, box.y, box.width, box.height, kRadius) +
                     rectangle("head", box.x, box.y, box.width, kHeaderHeight, kRadius) +
                     label("name", "middle", {middle, box.y + kNameLine}, node.name) +
                     label("model", "middle", {middle, box.y + kModelLine}, node.model);
  for (std::size_t i = 0; i < box.left.size(); ++i) {
    text += label("port", "start", {box.x + kPortText, row_y(box, i)}, box.left[i]);
  }
  for (std::size_t i = 0; i < box.right.size(); ++i) {
    const bool use = box.right[i].find("()") != std::string::npos;
    text += label(use ? "use" : "port", "end", {box.x + box.width - kPortText, row_y(box, i)},
                  box.right[i]);
  }
  return text;
}

std::string draw_lane(const WiringThread& thread, const Lane& lane, double width) {
  constexpr double kRadius = 8.0;
  const double x = kMargin / 2.0;
  const double y = lane.y + kLaneTitleHeight / 2.0 + kTextBaseline;
  return rectangle("lane", x, lane.y, width - kMargin, lane.height, kRadius) +
         "<text class=\"lane-title\" x=\"" + number(x + kMargin) + "\" y=\"" + number(y) + "\">" +
         base::xml_escaped(thread.name) + "<tspan class=\"lane-activity\" dx=\"10\">" +
         base::xml_escaped(thread.activity) + "</tspan></text>\n";
}

/// What the lines mean, below the lanes.
std::string draw_legend(Point at) {
  struct Line {
    std::string_view style;
    std::string_view marker;
    std::string_view meaning;
  };
  constexpr std::array<Line, 4> kLines = {{{"data", "data", "data"},
                                           {"trigger", "trigger", "data that triggers"},
                                           {"event", "trigger", "event"},
                                           {"peer", "peer", "use of a peer"}}};
  constexpr double kLength = 30.0;
  constexpr double kSpace = 8.0;
  std::string text;
  for (const Line& line : kLines) {
    const Point end{at.x + kLength, at.y};
    text += "<path class=\"" + std::string(line.style) + "\" marker-end=\"url(#" +
            std::string(line.marker) + ")\" d=\"M" + point(at) + " L" + point(end) + "\"/>\n" +
            label("model", "start", {end.x + kSpace, at.y}, line.meaning);
    at.x = end.x + text_width(line.meaning) + 3.0 * kSpace;
  }
  return text;
}

}  // namespace

std::string graph_as_svg(const exec::Blueprint& blueprint, const exec::Plan& plan,
                         const GraphOptions& options) {
  const Wiring wiring = make_wiring(blueprint, plan, options);
  const WiringLayout layout = place(wiring);
  const double width = std::max(layout.width, kLegendWidth);
  const double height = layout.height + kLegendHeight;
  const std::string size = "width=\"" + number(width) + "\" height=\"" + number(height) + "\"";
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" " + size + " viewBox=\"0 0 " +
                    number(width) + " " + number(height) + "\">\n<title>" +
                    base::xml_escaped(wiring.application) + "</title>\n" + std::string(kStyle) +
                    rectangle("page", 0, 0, width, height, 0) +
                    draw_legend({kMargin, layout.height + kLegendHeight / 3.0});
  for (std::size_t i = 0; i < wiring.threads.size(); ++i) {
    svg += draw_lane(wiring.threads[i], layout.lanes[i], layout.width);
  }
  for (std::size_t i = 0; i < wiring.edges.size(); ++i) {
    svg += draw_edge(wiring, wiring.edges[i], layout.ways[i]);
  }
  // No line crosses what is written.
  for (std::size_t i = 0; i < wiring.edges.size(); ++i) {
    svg += draw_note(wiring.edges[i], layout.ways[i]);
  }
  for (std::size_t i = 0; i < wiring.nodes.size(); ++i) {
    svg += draw_box(wiring.nodes[i], layout.boxes[i]);
  }
  return svg + "</svg>\n";
}

}  // namespace armature::analysis
