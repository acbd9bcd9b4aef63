// SPDX-License-Identifier: Apache-2.0
#include "armature/analysis/wiring_graph.hpp"

#include <algorithm>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pugixml.hpp>

#include "armature/analysis/wiring_layout.hpp"
#include "armature/deploy/internal/test_models.hpp"

namespace armature::deploy {

using namespace analysis;

using namespace document;
namespace {

using test::deploy;
using ::testing::HasSubstr;
using ::testing::Not;

/// Data, a trigger, a delay, a FIFO, a call, a peer that is not called, three threads.
Deployment example() {
  Deployment deployment = deploy(R"(
application: "a <b> & \"c\""
components:
  Source: {model: Source, activity: {periodic: 10 ms, priority: 80}}
  Echo: {model: Echo}
  Sink: {model: Sink, activity: {periodic: 20 ms}, delays: [Joint], peers: [Source]}
  Card: {model: Card}
  Joint: {model: Joint, activity: {triggered: true}, peers: [Card]}
connections:
  - Source.Out -> Echo.In
  - {from: Echo.Out, to: Sink.All, policy: {fifo: 8}}
  - Joint.Out -> Sink.In
)");
  EXPECT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  return deployment;
}

TEST(WiringGraph, DotHasAClusterForEachThreadAndAnEdgeForEachConnection) {
  const Deployment deployment = example();
  const std::string dot = graph_as_dot(deployment.blueprint, deployment.plan);
  EXPECT_THAT(dot, HasSubstr("digraph \"a <b> & \\\"c\\\"\""));
  EXPECT_THAT(dot, HasSubstr("label=\"Source: periodic 10 ms, priority 80\""));
  EXPECT_THAT(dot, HasSubstr("c1 [label=\"Echo\\nEcho\"]"));
  EXPECT_THAT(dot, HasSubstr("c0 -> c1 [label=\"Out → In\", penwidth=2]"));
  EXPECT_THAT(dot, HasSubstr("c1 -> c2 [label=\"Out → All (fifo 8)\"]"));
  EXPECT_THAT(dot, HasSubstr("c4 -> c2 [label=\"Out → In (one cycle later)\", constraint=false]"));
  EXPECT_THAT(dot, HasSubstr("c4 -> c3 [label=\"read()\", style=dashed"));
  EXPECT_THAT(dot, HasSubstr("c2 -> c0 [label=\"\", style=dashed"));
}

TEST(WiringGraph, MermaidShowsTheSame) {
  const Deployment deployment = example();
  const std::string text = graph_as_mermaid(deployment.blueprint, deployment.plan);
  EXPECT_THAT(text, HasSubstr("flowchart LR\n"));
  EXPECT_THAT(text, HasSubstr("subgraph t0[\"Source: periodic 10 ms, priority 80\"]"));
  EXPECT_THAT(text, HasSubstr("c1[\"<b>Echo</b><br>Echo\"]"));
  EXPECT_THAT(text, HasSubstr("c0 ==>|\"Out → In\"| c1"));
  EXPECT_THAT(text, HasSubstr("c1 -->|\"Out → All (fifo 8)\"| c2"));
  EXPECT_THAT(text, HasSubstr("c4 -.->|\"read()\"| c3"));
  EXPECT_THAT(text, HasSubstr("c2 -.-> c0"));
}

TEST(WiringGraph, SvgIsXmlWithATitleForEachEdge) {
  const Deployment deployment = example();
  const std::string svg = graph_as_svg(deployment.blueprint, deployment.plan);
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_string(svg.c_str());
  ASSERT_TRUE(parsed) << parsed.description() << "\n" << svg;
  EXPECT_STREQ(document.child("svg").child_value("title"), "a <b> & \"c\"");
  std::vector<std::string> titles;
  for (const pugi::xml_node path : document.child("svg").children("path")) {
    if (!path.child("title")) continue;  // of the legend
    titles.push_back(std::string(path.attribute("class").value()) + ": " +
                     path.child_value("title"));
  }
  EXPECT_THAT(titles, ::testing::UnorderedElementsAre(
                          "trigger: Source.Out → Echo.In, double [rad], triggers",
                          "data: Echo.Out → Sink.All, double [rad], fifo 8",
                          "data: Joint.Out → Sink.In, double [rad], one cycle later",
                          "peer: Joint.read() → Card, peer", "peer: Sink → Source, peer"));
}

bool overlap(const Box& a, const Box& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

/// Seven joints from cards to a controller and back.
Deployment robot() {
  Deployment deployment = deploy(R"(
components:
  Card{1..7}: {model: Card}
  Joint{1..7}: {model: Joint, activity: {periodic: 10 ms, thread: control}, peers: ["Card{i}"]}
  Mux: {model: Mux, activity: {periodic: 10 ms, thread: control}, properties: {joints: 7}}
  Echo{1..3}: {model: Echo}
  Sink{1..3}: {model: Sink, activity: {periodic: 100 ms}}
connections:
  - Joint{i}.Out -> Mux.Position{i}
  - Joint{1..3}.Out -> Echo{1..3}.In
  - Echo{i}.Out -> Sink{i}.In
)");
  EXPECT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  return deployment;
}

TEST(WiringLayout, BoxesLieInTheirLanesAndNotOnEachOther) {
  const Deployment deployment = robot();
  const Wiring wiring = make_wiring(deployment.blueprint, deployment.plan);
  const WiringLayout layout = place(wiring);
  for (std::size_t i = 0; i < layout.boxes.size(); ++i) {
    const Box& box = layout.boxes[i];
    const Lane& lane = layout.lanes[wiring.nodes[i].thread];
    EXPECT_GE(box.y, lane.y) << wiring.nodes[i].name;
    EXPECT_LE(box.y + box.height, lane.y + lane.height) << wiring.nodes[i].name;
    EXPECT_LE(box.x + box.width, layout.width) << wiring.nodes[i].name;
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_FALSE(overlap(box, layout.boxes[j]))
          << wiring.nodes[i].name << " and " << wiring.nodes[j].name;
    }
  }
  EXPECT_LE(layout.lanes.back().y + layout.lanes.back().height, layout.height);
}

TEST(WiringLayout, DataFlowsToTheRight) {
  const Deployment deployment = robot();
  const Wiring wiring = make_wiring(deployment.blueprint, deployment.plan);
  const WiringLayout layout = place(wiring);
  for (std::size_t e = 0; e < wiring.edges.size(); ++e) {
    const Way& way = layout.ways[e];
    EXPECT_FALSE(way.backward);
    EXPECT_LT(way.points.front().x, way.points.back().x);
    EXPECT_EQ(way.points.size() % 2, 0u);
  }
}

TEST(WiringLayout, ALoopIsDrawnWithAWayBack) {
  const Deployment deployment = deploy(R"(
components:
  A: {model: Echo, activity: {periodic: 10 ms}}
  B: {model: Echo}
  C: {model: Echo}
connections:
  - A.Out -> B.In
  - B.Out -> C.In
  - {from: C.Out, to: A.In, delay: one_cycle}
)");
  ASSERT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  const WiringLayout layout = place(make_wiring(deployment.blueprint, deployment.plan));
  EXPECT_FALSE(layout.ways[0].backward);
  EXPECT_FALSE(layout.ways[1].backward);
  ASSERT_TRUE(layout.ways[2].backward);
  EXPECT_EQ(layout.ways[2].points.size(), 8u);  // both ends, and through three layers
}

TEST(WiringGraph, AnEmptyApplicationHasAnEmptyPicture) {
  const Deployment deployment = deploy("application: nothing");
  EXPECT_THAT(graph_as_svg(deployment.blueprint, deployment.plan), HasSubstr("</svg>"));
  EXPECT_THAT(graph_as_dot(deployment.blueprint, deployment.plan), HasSubstr("digraph"));
}

}  // namespace
}  // namespace armature::deploy
