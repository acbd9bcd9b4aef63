// SPDX-License-Identifier: Apache-2.0
#include "armature/platform/elf/symbols.hpp"

#include <gtest/gtest.h>

namespace armature::platform {
namespace {

[[gnu::noinline]] void* here() { return __builtin_return_address(0); }

void* in_a_static_function() {
  void* const place = here();
  return place;
}

TEST(Symbols, NamesStaticFunctions) {
  const Symbols::Function function = Symbols().at(in_a_static_function());
  EXPECT_NE(function.name.find("armature::platform::(anonymous namespace)::"), std::string::npos)
      << function.name;
  EXPECT_EQ(function.place.rfind("platform_symbols_test+0x", 0), 0u) << function.place;
}

TEST(Symbols, KnowsNothingOfAnAddressThatIsNoCode) {
  const Symbols::Function function = Symbols().at(nullptr);
  EXPECT_EQ(function.name, "");
  EXPECT_EQ(function.place, "unknown code");
}

TEST(Symbols, DemanglesOnlyWhatIsMangled) {
  EXPECT_EQ(demangled("_ZN3Pid9on_updateEv"), "Pid::on_update()");
  EXPECT_EQ(demangled("main"), "main");
}

TEST(Symbols, LeavesShortNamesAsTheyAre) {
  for (const char* name :
       {"main", "Pid::on_update()", "(anonymous namespace)::step(double, int)::{lambda(int)#1}",
        "std::operator<(A const&, B const&)", "Pid::operator()(int) const",
        "operator new(unsigned long)"}) {
    EXPECT_EQ(shortened(name), name);
  }
}

TEST(Symbols, ShortensWhatNobodyReads) {
  EXPECT_EQ(shortened("std::vector<int, std::allocator<int> >::push_back(int&&)"),
            "std::vector<int>::push_back(int&&)");
  const std::string many(100, 'x');
  EXPECT_EQ(shortened("Engine::step(" + many + ") const"), "Engine::step(...) const");
  EXPECT_EQ(shortened("apply<&Pid::step>(A<" + many + ">, int)"), "apply<&Pid::step>(A<...>, int)");
}

TEST(Symbols, GetsOverBrokenNames) {
  EXPECT_EQ(shortened("f(a<b"), "f(a<b>)");
  EXPECT_EQ(shortened(""), "");
}

}  // namespace
}  // namespace armature::platform
