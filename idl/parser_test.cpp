// SPDX-License-Identifier: Apache-2.0
#include "idl/parser.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "idl/internal/test_program.hpp"
#include "idl/number.hpp"

namespace armature::idl {
namespace {

using internal::load_text;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// What a text without mistakes defines.
Module parsed(const std::string& text) {
  const Loaded loaded = load_text(text);
  EXPECT_TRUE(loaded.ok()) << loaded.findings();
  return loaded.program.main();
}

Operation only_operation(const std::string& declaration) {
  const Module module = parsed("struct S { int x; };\ninterface I { " + declaration + " };");
  EXPECT_EQ(module.interfaces.at(0).operations.size(), 1u);
  return module.interfaces.at(0).operations.at(0);
}

TEST(Parser, TakesThePapersGrammarAsPrintedWithoutSemicolons) {
  const Module module = parsed(R"(
    struct Colour { int red; short green; char blue; float weight; double gamma; String name; }
    event Seen { struct Colour colour; Array<int> places; }
    interface Camera {
      int initialize()
      void set(struct Colour colour, Array<double> curve)
      void start()
    }
  )");
  EXPECT_EQ(module.structures.size(), 2u);
  EXPECT_EQ(module.structures[0].members.size(), 6u);
  EXPECT_EQ(module.interfaces.at(0).operations.size(), 3u);
}

TEST(Parser, TakesSemicolonsBehindDefinitionsAndOperations) {
  const Module module = parsed("event E { int x; }; interface I { void f(); int g(int a); };");
  EXPECT_EQ(module.interfaces.at(0).operations.size(), 2u);
}

TEST(Parser, AnEnumeratorWithoutANumberIsOneMoreThanTheOneBefore) {
  const Module module = parsed("enum E : short { a = -2, b, c, d, e = 7, f, } enum F { g };");
  ASSERT_EQ(module.enumerations.size(), 2u);
  EXPECT_EQ(module.enumerations[0].underlying, Basic::kShort);
  EXPECT_EQ(module.enumerations[1].underlying, Basic::kByte);
  std::string all;
  for (const Enumerator& each : module.enumerations[0].enumerators) {
    all += each.name + "=" + to_text(each.value) + " ";
  }
  EXPECT_EQ(all, "a=-2 b=-1 c=0 d=1 e=7 f=8 ");
  EXPECT_EQ(module.enumerations[0].first_value().name, "c");
}

TEST(Parser, EnumeratorsHaveTheirDocumentation) {
  const Module module = parsed(R"(
    /// How it moves.
    enum Mode {  ///< always
      idle,  ///< not at all
      /// By itself.
      position = 4  ///< to a point
    };
  )");
  const Enumeration& mode = module.enumerations.at(0);
  EXPECT_THAT(mode.doc, ElementsAre("How it moves.", "always"));
  EXPECT_THAT(mode.enumerators[0].doc, ElementsAre("not at all"));
  EXPECT_THAT(mode.enumerators[1].doc, ElementsAre("By itself.", "to a point"));
}

TEST(Parser, EnumIsANameWhereverItBeginsNoDefinitionAndNoType) {
  const Module module = parsed(R"(
    struct enum { int enum; };
    interface I { struct enum enum(int enum, struct enum); enum Mode mode(enum Mode enum); };
    enum Mode { enum };
  )");
  EXPECT_EQ(module.structures.at(0).name, "enum");
  EXPECT_EQ(module.interfaces.at(0).operations[0].name, "enum");
  EXPECT_EQ(to_text(module.interfaces[0].operations[1].result), "enum Mode");
}

TEST(Parser, AnEnumHasAtMost256Enumerators) {
  std::string text = "enum Many : short { zero";
  for (int i = 1; i < 256; ++i) text += ", e" + std::to_string(i);
  EXPECT_EQ(parsed(text + "}").enumerations.at(0).enumerators.size(), 256u);
  EXPECT_THAT(load_text(text + ", more }").findings(),
              HasSubstr("enum 'Many' has 257 enumerators; at most 256 are possible"));
}

TEST(Parser, AnEnumCountsInWhatIsWrittenOut) {
  std::string text = "enum Long : short { zero";
  for (int i = 1; i < 256; ++i) {
    text += ", e" + std::to_string(i) + "_" + std::string(58, 'x');
  }
  EXPECT_THAT(load_text(text + "}; interface I { void set(enum Long value); };").findings(),
              HasSubstr("operation 'set', with its structs written out, has more than 16384"));
}

TEST(Parser, AllEventsOfAFileAreRaisedWhereNoInterfaceNamesOne) {
  const Module module =
      parsed("event E { int x; }; event F { int x; }; interface I { void f(); };");
  EXPECT_EQ(module.interfaces[0].events.size(), 2u);
}

TEST(Parser, AnInterfaceRaisesTheEventsThatItNames) {
  const Module module = parsed(
      "event E { int x; }; event F { int x; };"
      "interface I { void f(); event F; }; interface J { void f(); };");
  ASSERT_EQ(module.interfaces[0].events.size(), 1u);
  EXPECT_EQ(module.interfaces[0].events[0].name, "F");
  EXPECT_THAT(module.interfaces[1].events, IsEmpty());
}

TEST(Parser, AnInterfaceMayHaveEventsOnly) {
  EXPECT_EQ(parsed("event E { int x; } interface I { event E; };").interfaces[0].events.size(), 1u);
}

TEST(Parser, ParametersNeedNoName) {
  const Operation operation =
      only_operation("int set(unsigned int, unsigned int, Array<long, 3> c)");
  ASSERT_EQ(operation.parameters.size(), 3u);
  EXPECT_EQ(operation.parameters[0].name, "");
  EXPECT_EQ(operation.parameters[1].type.basic, Basic::kUnsignedInt);
  EXPECT_EQ(operation.parameters[2].name, "c");
}

TEST(Parser, EveryTypeIsWrittenAsItWasRead) {
  for (const std::string type :
       {"bool", "char", "byte", "short", "unsigned short", "int", "unsigned int", "long",
        "unsigned long", "float", "double", "String", "struct S", "Array<bool>", "Array<String>",
        "Array<struct S>", "Array<unsigned short, 7>", "Array<struct S, 4194304>"}) {
    EXPECT_EQ(to_text(only_operation(type + " f();").result), type);
  }
}

TEST(Parser, AnOperationOfVoidIsACommand) {
  EXPECT_TRUE(only_operation("void f();").is_command());
  EXPECT_FALSE(only_operation("bool f();").is_command());
}

TEST(Parser, AccessIsCommandUnlessItIsGiven) {
  EXPECT_EQ(only_operation("void f();").access, Access::kCommand);
  EXPECT_EQ(only_operation("[access(\"read\")] int f();").access, Access::kRead);
  EXPECT_EQ(only_operation("[access(\"configure\")] int f();").access, Access::kConfigure);
}

TEST(Parser, AnOperationAnswersWhenItReturnsUnlessItIsDeclaredToDoSoLater) {
  EXPECT_FALSE(only_operation("int f();").later);
  EXPECT_TRUE(only_operation("[access(\"read\"), later] int f();").later);
}

TEST(Parser, AttributesMayShareBracketsOrHaveTheirOwn) {
  const auto parameter = [](const std::string& text) {
    return only_operation("void f(" + text + " double q);").parameters.at(0);
  };
  for (const std::string text :
       {"[unit(\"rad\"), range(-1.5, 2e1)]", "[range(-1.5, 2e1)] [unit(\"rad\")]"}) {
    const Field field = parameter(text);
    EXPECT_EQ(field.unit, "rad");
    ASSERT_TRUE(field.range);
    EXPECT_EQ(field.range->low, "-1.5");
    EXPECT_EQ(field.range->high, "2e1");
  }
}

TEST(Parser, DocumentationBelongsToWhatFollowsOrStandsBefore) {
  const Module module = parsed(R"(
    /// A place.
    ///
    /// On the floor.
    struct P {  // no documentation
      /// first axis
      [unit("m")] double x;  ///< in front
      //// nor is this
      double y;  ///< to the left
    };
    /// Moves.
    interface I {
      /// Goes there.
      /// Does not wait.
      void go(double x,  ///< where
              double y /* nor this */);  ///< Now.
    };
  )");
  const Structure& place = module.structures.at(0);
  EXPECT_THAT(place.doc, ElementsAre("A place.", "", "On the floor."));
  EXPECT_THAT(place.members.at(0).doc, ElementsAre("first axis", "in front"));
  EXPECT_THAT(place.members.at(1).doc, ElementsAre("to the left"));
  const Interface& interface = module.interfaces.at(0);
  EXPECT_THAT(interface.doc, ElementsAre("Moves."));
  const Operation& operation = interface.operations.at(0);
  EXPECT_THAT(operation.doc, ElementsAre("Goes there.", "Does not wait.", "Now."));
  EXPECT_THAT(operation.parameters.at(0).doc, ElementsAre("where"));
  EXPECT_THAT(operation.parameters.at(1).doc, IsEmpty());
}

TEST(Parser, WordsThatBeginDefinitionsAreNamesInsideOfOne) {
  const Module module = parsed(
      "struct S { String interface; int event; int import; };"
      "interface I { int event(int interface); };");
  EXPECT_EQ(module.structures.at(0).members.at(1).name, "event");
  EXPECT_EQ(module.interfaces.at(0).operations.at(0).parameters.at(0).name, "interface");
}

TEST(Parser, DefinitionsMayStandInAnyOrder) {
  parsed("interface I { struct B f(); }; struct B { struct A a; }; struct A { int x; };");
}

TEST(Parser, LinesMayEndAsOnWindows) {
  const Module module = parsed("/// Doc.\r\nstruct S {\r\n  int x;\r\n};\r\n");
  EXPECT_THAT(module.structures.at(0).doc, ElementsAre("Doc."));
}

TEST(Parser, GoesOnBehindEachMistake) {
  const Loaded loaded = load_text(
      "struct A { int x y; int ok; };\n"
      "event B { strin x; };\n"
      "interface C { int f(int a; int b); void g(; void h(Foo x); int i(struct Nobody n); };\n"
      "struct D { struct None none; };\n");
  const std::string findings = loaded.findings();
  for (const std::string place : {"1:17", "2:11", "3:26", "3:43", "3:52", "3:66", "4:12"}) {
    EXPECT_THAT(findings, HasSubstr("test.idl:" + place + ": error: ")) << findings;
  }
}

TEST(Parser, AnEmptyFileDefinesNothing) { EXPECT_THAT(parsed("").structures, IsEmpty()); }

}  // namespace
}  // namespace armature::idl
