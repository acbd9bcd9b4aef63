// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/analysis/wiring.hpp"
#include "armature/analysis/wiring_graph.hpp"
#include "armature/analysis/wiring_layout.hpp"
#include "armature/deploy/internal/test_models.hpp"

namespace armature::deploy {

using namespace analysis;
namespace {

using test::deploy;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

/// Seven joints in one thread with a card each, read by one component; a source that nobody needs.
Deployment robot() {
  Deployment deployment = deploy(R"(
components:
  Card{1..7}: {model: Card}
  Joint{1..7}: {model: Joint, activity: {periodic: 10 ms, thread: control}, peers: ["Card{i}"]}
  Mux: {model: Mux, activity: {periodic: 10 ms, thread: control}, properties: {joints: 7}}
  Source: {model: Source, activity: {periodic: 10 ms}}
  Echo: {model: Echo}
connections:
  - Joint{i}.Out -> Mux.Position{i}
  - Source.Out -> Echo.In
)");
  EXPECT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  return deployment;
}

Wiring wiring_of(const Deployment& deployment, const GraphOptions& options) {
  return make_wiring(deployment.blueprint, deployment.plan, options);
}

std::vector<std::string> names_in(const Wiring& wiring) {
  std::vector<std::string> names;
  for (const WiringNode& node : wiring.nodes) names.push_back(node.name);
  return names;
}

const WiringEdge* edge_between(const Wiring& wiring, const std::string& from,
                               const std::string& to) {
  for (const WiringEdge& edge : wiring.edges) {
    if (wiring.nodes[edge.from].name == from && wiring.nodes[edge.to].name == to) return &edge;
  }
  return nullptr;
}

TEST(WiringBundles, ComponentsThatDifferByTheirNumberShareABox) {
  const Wiring wiring = wiring_of(robot(), {});
  EXPECT_THAT(names_in(wiring),
              UnorderedElementsAre("Card1..7", "Joint1..7", "Mux", "Source", "Echo"));
  EXPECT_EQ(wiring.nodes[wiring.edges[0].from].model, "7 × Joint");
  for (std::size_t i = 0; i < wiring.nodes.size(); ++i) {
    EXPECT_THAT(wiring.threads[wiring.nodes[i].thread].nodes, Contains(i)) << wiring.nodes[i].name;
  }
}

TEST(WiringBundles, ConnectionsOfTwoBoxesAreOneLineThatListsThem) {
  const Wiring wiring = wiring_of(robot(), {});
  const WiringEdge* const data = edge_between(wiring, "Joint1..7", "Mux");
  ASSERT_NE(data, nullptr);
  EXPECT_EQ(data->from_port, "Out");
  EXPECT_EQ(data->to_port, "Position1..7");
  ASSERT_EQ(data->bundled.size(), 7u);
  EXPECT_THAT(data->bundled[6], HasSubstr("Joint7.Out → Mux.Position7, double"));
  const WiringEdge* const calls = edge_between(wiring, "Joint1..7", "Card1..7");
  ASSERT_NE(calls, nullptr);
  EXPECT_EQ(calls->kind, WiringEdge::Kind::kPeer);
  EXPECT_EQ(calls->bundled.size(), 7u);
  EXPECT_EQ(wiring.edges.size(), 3u);
}

TEST(WiringBundles, OneConnectionStaysWhatItIs) {
  const Wiring wiring = wiring_of(robot(), {});
  const WiringEdge* const single = edge_between(wiring, "Source", "Echo");
  ASSERT_NE(single, nullptr);
  EXPECT_TRUE(single->bundled.empty());
  EXPECT_EQ(single->from_port, "Out");
}

TEST(WiringBundles, WhatIsNotTheSameModelOrThreadOrKindStaysApart) {
  const Deployment deployment = deploy(R"(
components:
  A1: {model: Source, activity: {periodic: 10 ms, thread: fast}}
  A2: {model: Source, activity: {periodic: 20 ms, thread: slow}}
  A3: {model: Card, activity: {periodic: 10 ms, thread: fast}}
  B: {model: Sink, activity: {periodic: 10 ms, thread: fast}}
connections:
  - A1.Out -> B.In
  - A1.Out -> B.All
)");
  ASSERT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  const Wiring wiring = wiring_of(deployment, {});
  EXPECT_THAT(names_in(wiring), UnorderedElementsAre("A1", "A2", "A3", "B"));
  const Wiring each = wiring_of(deployment, {.each_line = true, .only = {}});
  EXPECT_EQ(each.edges.size(), wiring.edges.size() + 1) << "In and All, neither of which triggers";
}

TEST(WiringBundles, EachLineShowsEveryConnection) {
  const Deployment deployment = robot();
  const Wiring wiring = wiring_of(deployment, {.each_line = true, .only = {}});
  EXPECT_EQ(wiring.nodes.size(), deployment.blueprint.components.size());
  EXPECT_EQ(wiring.edges.size(), 15u);
}

TEST(WiringBundles, NumbersWithGapsAreToldAsTheyAre) {
  const Deployment deployment = deploy(R"(
components:
  Echo1: {model: Echo}
  Echo2: {model: Echo}
  Echo3: {model: Echo}
  Echo10: {model: Echo}
  Echo02: {model: Echo}
  Source: {model: Source, activity: {periodic: 10 ms}}
connections:
  - Source.Out -> Echo1.In
  - Source.Out -> Echo2.In
  - Source.Out -> Echo3.In
  - Source.Out -> Echo10.In
  - Source.Out -> Echo02.In
)");
  ASSERT_TRUE(deployment.ok()) << deployment.diagnostics.to_text();
  EXPECT_THAT(names_in(wiring_of(deployment, {})),
              UnorderedElementsAre("Echo1..3,10", "Echo02", "Source"));
}

TEST(WiringSelection, ShowsTheNamedOnesWithTheirNeighbours) {
  const Wiring wiring = wiring_of(robot(), {.each_line = false, .only = {"Joint3"}});
  EXPECT_THAT(names_in(wiring), UnorderedElementsAre("Card3", "Joint3", "Mux"));
  EXPECT_EQ(wiring.edges.size(), 2u);
  for (const WiringThread& thread : wiring.threads) EXPECT_FALSE(thread.nodes.empty());
  EXPECT_THAT(names_in(wiring_of(robot(), {.each_line = false, .only = {"Source", "Card1"}})),
              UnorderedElementsAre("Card1", "Joint1", "Source", "Echo"));
}

TEST(WiringSelection, TakesRangesAndRefusesWhatNoComponentIsCalled) {
  const Deployment deployment = robot();
  EXPECT_THAT(components_named("Joint{2..4}", deployment.blueprint).value(),
              ElementsAre("Joint2", "Joint3", "Joint4"));
  EXPECT_THAT(components_named("Mux", deployment.blueprint).value(), ElementsAre("Mux"));
  const auto near = components_named("Sorce", deployment.blueprint);
  ASSERT_FALSE(near);
  EXPECT_EQ(near.error(), "--only: unknown component 'Sorce' (did you mean 'Source'?)");
  const auto beyond = components_named("Joint{7..2000000000}", deployment.blueprint);
  ASSERT_FALSE(beyond);
  EXPECT_THAT(beyond.error(), HasSubstr("--only"));
}

TEST(WiringBundles, EveryFormatHasTheCountAndTheList) {
  const Deployment deployment = robot();
  const std::string svg = graph_as_svg(deployment.blueprint, deployment.plan);
  EXPECT_THAT(svg, HasSubstr("7 connections:\nJoint1.Out → Mux.Position1"));
  EXPECT_THAT(svg, HasSubstr(">7 ×</text>"));
  EXPECT_THAT(svg, HasSubstr(">Joint1..7</text>"));
  const std::string dot = graph_as_dot(deployment.blueprint, deployment.plan);
  EXPECT_THAT(dot, HasSubstr("Out → Position1..7 × 7\""));
  EXPECT_THAT(dot, HasSubstr("tooltip=\"Joint1.Out → Mux.Position1"));
  const std::string mermaid = graph_as_mermaid(deployment.blueprint, deployment.plan);
  EXPECT_THAT(mermaid, HasSubstr("|\"Out → Position1..7 × 7\"|"));
  EXPECT_THAT(mermaid, HasSubstr("\n  %% Joint7.Out → Mux.Position7"));
  const GraphOptions each{.each_line = true, .only = {}};
  EXPECT_THAT(graph_as_svg(deployment.blueprint, deployment.plan, each),
              Not(HasSubstr("connections:")));
}

TEST(WiringBundles, ABundledPictureHasRoomForItsBoxes) {
  const Wiring wiring = wiring_of(robot(), {});
  const WiringLayout layout = place(wiring);
  for (std::size_t i = 0; i < layout.boxes.size(); ++i) {
    const Lane& lane = layout.lanes[wiring.nodes[i].thread];
    EXPECT_GE(layout.boxes[i].y, lane.y) << wiring.nodes[i].name;
    EXPECT_LE(layout.boxes[i].y + layout.boxes[i].height, lane.y + lane.height);
  }
}

}  // namespace
}  // namespace armature::deploy
