// SPDX-License-Identifier: Apache-2.0
#include "idl/canonical.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/base/hash.hpp"
#include "idl/internal/test_program.hpp"

namespace armature::idl {
namespace {

using internal::load_text;
using ::testing::ElementsAre;

Loaded protocol() {
  Loaded loaded = load_text(R"(
    event ObjectPosition { int x; int y; };
    interface Wheels { void setVelocity(float left, float right); };
    interface Vision {
      int setThreshold(unsigned int a, unsigned int b, unsigned int c);
      void start();
      event ObjectPosition;
    };
    interface Arm { void moveTo(Array<double> position, double time); };
  )");
  EXPECT_TRUE(loaded.ok()) << loaded.findings();
  return loaded;
}

TEST(Canonical, DeclarationsAndNumbersAreThoseOfTheProtocol) {
  const Loaded loaded = protocol();
  const Module& main = loaded.program.main();
  const auto expect = [&](const auto& what, const std::string& text, std::uint32_t number) {
    EXPECT_EQ(canonical(loaded.program, what), text);
    EXPECT_EQ(number_of(text), number) << text;
  };
  expect(main.interfaces[0].operations[0], "void setVelocity(float,float)", 0x66e299df);
  expect(main.interfaces[1].operations[0],
         "int setThreshold(unsigned int,unsigned int,unsigned int)", 0x22f17958);
  expect(main.interfaces[1].operations[1], "void start()", 0xdcab56ac);
  expect(main.structures[0], "event ObjectPosition{int,int}", 0x714c2b59);
  expect(main.interfaces[2].operations[0], "void moveTo(Array<double>,double)", 0xd53a44a9);
}

TEST(Canonical, StructsAreWrittenOut) {
  const Loaded loaded = load_text(R"(
    struct Point { double x; double y; };
    struct Line { Array<struct Point, 2> ends; String name; };
    interface I { struct Line longest(Array<struct Line>, Array<unsigned long, 4>); };
  )");
  ASSERT_TRUE(loaded.ok()) << loaded.findings();
  EXPECT_EQ(canonical(loaded.program, loaded.program.main().interfaces[0].operations[0]),
            "struct Line{Array<struct Point{double,double},2>,String} "
            "longest(Array<struct Line{Array<struct Point{double,double},2>,String}>,"
            "Array<unsigned long,4>)");
}

TEST(Canonical, EnumsAreWrittenOutWithTheirNumbers) {
  const Loaded loaded = load_text(R"(
    enum Mode { idle, position = 4, velocity };
    enum Sign : unsigned short { none };
    interface I { Array<enum Mode, 2> swap(enum Sign, Array<enum Mode>); };
  )");
  ASSERT_TRUE(loaded.ok()) << loaded.findings();
  const Module& main = loaded.program.main();
  EXPECT_EQ(canonical(main.enumerations[0]), "enum Mode:byte{idle=0,position=4,velocity=5}");
  EXPECT_EQ(canonical(loaded.program, main.interfaces[0].operations[0]),
            "Array<enum Mode:byte{idle=0,position=4,velocity=5},2> "
            "swap(enum Sign:unsigned short{none=0},"
            "Array<enum Mode:byte{idle=0,position=4,velocity=5}>)");
}

TEST(Canonical, NamesUnitsAndDocumentationDoNotCount) {
  const auto declaration = [](const std::string& text) {
    const Loaded loaded = load_text("interface I { " + text + " };");
    EXPECT_TRUE(loaded.ok()) << loaded.findings();
    return canonical(loaded.program, loaded.program.main().interfaces[0].operations[0]);
  };
  EXPECT_EQ(declaration("/** no doc */ int f([unit(\"m\"), range(0, 1)] double x);"),
            declaration("int   f ( double )"));
}

TEST(Canonical, TheDigestIsOfTheSortedDeclarations) {
  const Loaded loaded = protocol();
  const Interface& vision = loaded.program.main().interfaces[1];
  EXPECT_THAT(
      declarations(loaded.program, vision),
      ElementsAre("event ObjectPosition{int,int}",
                  "int setThreshold(unsigned int,unsigned int,unsigned int)", "void start()"));
  EXPECT_EQ(digest(loaded.program, vision),
            base::fnv1a("event ObjectPosition{int,int};"
                        "int setThreshold(unsigned int,unsigned int,unsigned int);void start()"));
}

}  // namespace
}  // namespace armature::idl
