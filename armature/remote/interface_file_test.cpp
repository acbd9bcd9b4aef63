// SPDX-License-Identifier: Apache-2.0
#include "armature/remote/interface_file.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/component/interface.hpp"
#include "armature/remote/internal/described_component.hpp"
#include "idl/canonical.hpp"
#include "idl/load.hpp"

namespace armature::remote {
namespace {

using component::interface_of;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

/// A file that is there as long as the test.
struct InterfaceFile : testing::Test {
  ~InterfaceFile() override { std::remove(path.c_str()); }

  component::Component* read(const std::string& text, const std::string& name = {},
                             const std::string& remote = "tcp://127.0.0.1:4242/Vision") {
    std::ofstream(path) << text;
    written.name = "Eye";
    written.remote = {remote, {"robot.yaml", 1, 10}};
    written.interface = {path, {"robot.yaml", 1, 40}};
    made = read_interface(written, path + name, diagnostics);
    return made.get();
  }
  std::string texts() const { return diagnostics.to_text(); }

  const std::string path = testing::TempDir() + "armature_interface_file.idl";
  document::Component written;
  base::Diagnostics diagnostics;
  std::unique_ptr<component::Component> made;
};

template <typename List>
std::string members(const List& list) {
  std::string text;
  for (const auto* each : list) {
    text +=
        (text.empty() ? "" : "; ") + std::string(each->name()) + ": " + each->signature().text();
  }
  return text;
}

template <typename List>
std::string ports(const List& list) {
  std::string text;
  for (const auto* each : list) {
    text += (text.empty() ? "" : "; ") + each->name() + ": " + each->type().name + " [" +
            std::string(each->unit()) + "]";
  }
  return text;
}

TEST_F(InterfaceFile, MakesTheMembersOfAComponent) {
  const auto* eye = read(R"(
enum Mode { idle, follow };
struct Pose { [unit("m")] double x; Array<float, 2> size; enum Mode mode; String name; };
/// Where it is.
event Seen { [unit("px")] int x; struct Pose pose; };
interface Vision {
  /// Goes on.
  void start([unit("s")] double pause, String label, Array<double> gains);
  int ask(String question, Array<String> words);
  String name();
  event Seen;
};)");
  ASSERT_NE(eye, nullptr) << texts();
  EXPECT_EQ(texts(), "");
  EXPECT_EQ(written.model, "Vision");
  EXPECT_EQ(members(interface_of(*eye).operations),
            "start: void(double pause [s], const text<127>& label, const vector<double>& gains); "
            "ask: int32(const text& question, const vector<text>& words); name: text()");
  EXPECT_EQ(members(interface_of(*eye).events), "Seen: void(int32 x [px], Pose pose)");
  EXPECT_EQ(interface_of(*eye).operations[0]->doc(), "Goes on.");
  EXPECT_TRUE(interface_of(*eye).operations[0]->is_command());
  EXPECT_FALSE(interface_of(*eye).operations[1]->is_command());
}

TEST_F(InterfaceFile, PortsHaveTheFormThatTheyHaveOnTheWire) {
  const auto* eye = read(R"(
event Height { unsigned long sequence; long time; [unit("m")] double value; };
event Other { unsigned long sequence; long when; double value; };
interface Vision {
  void Wish([unit("m/s")] float value);
  void wishes(float values);
  event Height;
  event Other;
};)");
  ASSERT_NE(eye, nullptr) << texts();
  EXPECT_EQ(ports(interface_of(*eye).inputs), "Wish: float [m/s]");
  EXPECT_EQ(ports(interface_of(*eye).outputs), "Height: double [m]");
  EXPECT_EQ(members(interface_of(*eye).operations), "wishes: void(float values)");
  EXPECT_EQ(members(interface_of(*eye).events),
            "Other: void(uint64 sequence, int64 when, double value)");
}

TEST_F(InterfaceFile, ACommandHasItsCancellationAndProgress) {
  read(R"(
event travel_progress { double progress; };
event wait_progress { int progress; };
interface Vision {
  void cancel_travel();
  void travel(double height);
  void cancel_everything();
  event travel_progress;
  event wait_progress;
};)");
  ASSERT_NE(made, nullptr) << texts();
  EXPECT_EQ(members(interface_of(*made).operations),
            "travel: void(double height); cancel_everything: void()");
  EXPECT_EQ(members(interface_of(*made).events), "wait_progress: void(int32 progress)");
  const auto& numbers = *dynamic_cast<internal::DescribedComponent&>(*made).numbers;
  EXPECT_EQ(numbers.number(NumberedMember::Kind::kCancel, 0),
            ride::number_of("void cancel_travel()"));
  EXPECT_EQ(numbers.number(NumberedMember::Kind::kProgress, 0),
            ride::number_of("event travel_progress{double}"));
  EXPECT_EQ(numbers.number(NumberedMember::Kind::kCancel, 1), 0u);
}

TEST_F(InterfaceFile, SaysHowUrgentItsMessagesAre) {
  read(R"(
interface Vision {
  [priority(20)] void travel(double height);
  [priority(255)] void cancel_travel();
  [priority(200)] void stop();
  [priority(7)] int where();
  [priority(9)] void Wish(double value);
  void start();
};)");
  ASSERT_NE(made, nullptr) << texts();
  const auto& numbers = *dynamic_cast<internal::DescribedComponent&>(*made).numbers;
  const auto level = [&](NumberedMember::Kind kind, std::size_t index) {
    const NumberedMember* const member = numbers.member(kind, index);
    return member == nullptr ? -1 : int{member->priority.level};
  };
  EXPECT_EQ(level(NumberedMember::Kind::kCommand, 0), 20);
  EXPECT_EQ(level(NumberedMember::Kind::kCancel, 0), 20) << "never before its command";
  EXPECT_EQ(level(NumberedMember::Kind::kCommand, 1), 200);
  EXPECT_EQ(level(NumberedMember::Kind::kOperation, 2), 7);
  EXPECT_EQ(level(NumberedMember::Kind::kCommand, 3), 0);
  EXPECT_EQ(level(NumberedMember::Kind::kInput, 0), 9);
  EXPECT_EQ(level(NumberedMember::Kind::kOutput, 0), -1);
}

TEST_F(InterfaceFile, KnowsTheRangesOfWhatComes) {
  read(R"(
struct Wheel { [range(-5, 5)] short speed; [unit("m"), range(0.5, 1e3)] Array<double, 2> size; };
event Seen { [range(0, 255)] unsigned int red; Array<struct Wheel, 2> wheels; };
event Speed { unsigned long sequence; long time; [range(-1, 1)] float value; };
interface Vision { event Seen; event Speed; };
)");
  ASSERT_NE(made, nullptr) << texts();
  const auto& numbers = *dynamic_cast<internal::DescribedComponent&>(*made).numbers;
  const auto& arguments = interface_of(*made).events.front()->signature().arguments;
  const auto& ranges = numbers.member(NumberedMember::Kind::kEvent, 0)->ranges;
  const auto holds = [&](const std::string& red, const std::string& wheels) {
    types::Value values[] = {types::Value(*arguments[0].type), types::Value(*arguments[1].type)};
    EXPECT_TRUE(types::from_text(values[0].type(), red, values[0].data()));
    EXPECT_TRUE(types::from_text(values[1].type(), wheels, values[1].data()));
    return std::ranges::all_of(
        ranges, [&](const auto& each) { return each.holds(values[each.argument].data()); });
  };
  EXPECT_TRUE(holds("255", "[{speed: 5, size: [0.5, 1000]}, {speed: -5, size: [1, 1]}]"));
  EXPECT_FALSE(holds("256", "[{speed: 5, size: [0.5, 1000]}, {speed: -5, size: [1, 1]}]"));
  EXPECT_FALSE(holds("0", "[{speed: 6, size: [1, 1]}, {speed: 0, size: [1, 1]}]"));
  EXPECT_FALSE(holds("0", "[{speed: 0, size: [1, 1]}, {speed: 0, size: [1, 0.4]}]"));
  EXPECT_FALSE(holds("0", "[{speed: 0, size: [1, 1]}, {speed: 0, size: [nan, 1]}]"));
  const auto& speed = numbers.member(NumberedMember::Kind::kOutput, 0)->ranges;
  ASSERT_EQ(speed.size(), 1u);
  const float one = 1.0f;
  const float more = 1.01f;
  EXPECT_TRUE(speed.front().holds(&one));
  EXPECT_FALSE(speed.front().holds(&more));
}

TEST_F(InterfaceFile, IsTheInterfaceThatItsGeneratedServiceHas) {
  read(R"(
struct Place { double x; };
event Seen { bool yes; };
interface Vision {
  [access("configure")] int follow(Array<struct Place> route);
  void start();
  event Seen;
};)");
  ASSERT_NE(made, nullptr) << texts();
  const auto& numbers = *dynamic_cast<internal::DescribedComponent&>(*made).numbers;
  const idl::Loaded loaded = idl::load(path);
  EXPECT_EQ(ride::digest(numbers.interface()),
            idl::digest(loaded.program, loaded.program.main().interfaces.front()));
  EXPECT_EQ(numbers.interface().name, "Vision");
}

TEST_F(InterfaceFile, WhatCannotBeHereIsLeftOutWithANote) {
  read(R"(struct Place { double x; Array<int> list; };
event Route { Array<double> heights; };
event Scan { Array<double, 600> ranges; };
event PeerLost { int a; };
interface Vision {
  int follow(Array<struct Place> route);
  void say(Array<String> words);
  struct Place place();
  void start();
  event Route;
  event Scan;
  event PeerLost;
};)");
  ASSERT_NE(made, nullptr);
  EXPECT_TRUE(diagnostics.ok());
  EXPECT_EQ(members(interface_of(*made).operations), "start: void()");
  EXPECT_THAT(members(interface_of(*made).events), IsEmpty());
  EXPECT_THAT(texts(), HasSubstr("armature_interface_file.idl:6:7: note: operation 'follow' of "
                                 "interface 'Vision' is left out: struct Place, list: Array<int> "
                                 "has no fixed size: give it a number of elements"));
  EXPECT_THAT(texts(),
              HasSubstr("operation 'say' of interface 'Vision' is left out: vector<text<"));
  EXPECT_THAT(texts(), HasSubstr("operation 'place' of interface 'Vision' is left out: struct"));
  EXPECT_THAT(texts(), HasSubstr("event 'Route' of interface 'Vision' is left out: Array<double>"));
  EXPECT_THAT(texts(), HasSubstr("event 'Scan' of interface 'Vision' is left out: "
                                 "array<double,600> has 4800 bytes, more than the 4096"));
  EXPECT_THAT(texts(), HasSubstr("event 'PeerLost' of interface 'Vision' is left out: the "
                                 "component has another member of this name"));
}

TEST_F(InterfaceFile, EachMistakeIsToldAtItsPlace) {
  EXPECT_EQ(read("event E { strin a; };\ninterface Vision {\n  void f(in a);\n};\n"), nullptr);
  EXPECT_THAT(texts(), AllOf(HasSubstr("armature_interface_file.idl:1:11: error: unknown type "
                                       "'strin'"),
                             HasSubstr("armature_interface_file.idl:3:10: error: ")));
}

TEST_F(InterfaceFile, AFileThatIsMissingIsAMistakeOfTheDeployment) {
  written.name = "Eye";
  written.interface = {"no.idl", {"robot.yaml", 1, 40}};
  EXPECT_EQ(read_interface(written, "no.idl", diagnostics), nullptr);
  EXPECT_THAT(texts(), HasSubstr("robot.yaml:1:40: error: 'Eye', interface: file 'no.idl' does "
                                 "not exist"));
}

constexpr const char* kTwo =
    "interface Vision { void start(); };\ninterface Chassis { void go(); };";

TEST_F(InterfaceFile, IsChosenByNameOrByThatOfTheComponentThere) {
  read(kTwo);
  EXPECT_EQ(written.model, "Vision");
  read(kTwo, "#Chassis");
  EXPECT_EQ(written.model, "Chassis");
  read("interface Chassis { void go(); };");
  EXPECT_EQ(written.model, "Chassis");
  EXPECT_EQ(texts(), "");
}

TEST_F(InterfaceFile, OneThatIsMissingIsToldWithThoseThereAre) {
  EXPECT_EQ(read(kTwo, "#Chasis"), nullptr);
  EXPECT_THAT(texts(), HasSubstr("robot.yaml:1:40: error: "));
  EXPECT_THAT(texts(), HasSubstr("has no interface 'Chasis' (did you mean 'Chassis'?)"));
  EXPECT_EQ(read(kTwo, {}, "tcp://127.0.0.1:4242/Eye"), nullptr);
  EXPECT_THAT(texts(), HasSubstr("has 2 interfaces, and none of them is called 'Eye'"));
  EXPECT_THAT(texts(), HasSubstr("#Vision)"));
  EXPECT_EQ(read("struct A { int a; };"), nullptr);
  EXPECT_THAT(texts(), HasSubstr("has no interface (name the file that defines it)"));
}

}  // namespace
}  // namespace armature::remote
