// SPDX-License-Identifier: Apache-2.0
#include "armature/remote/interface_numbers.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/author.hpp"
#include "armature/component/interface.hpp"

namespace armature::remote {
namespace {

using component::Command;
using component::Event;
using component::InputPort;
using component::Operation;
using component::Outcome;
using component::OutputPort;
using component::serve;

class Generator final : public component::Component {
 public:
  using Component::Component;
  Command<const std::vector<double>&, double> move_to{this, "moveTo", serve<&Generator::move>, ""};
  Operation<int(float)> probe{this, "probe", serve<&Generator::serve_probe>, ""};
  Event<int, bool> reached{this, "Reached", ""};
  OutputPort<double> position{this, "Position", ""};
  InputPort<std::vector<double>> wish{this, "Wish", "", "", component::fixed_size(2)};

 private:
  Outcome move(const std::vector<double>&, double) { return component::accepted(); }
  int serve_probe(float) { return 0; }
};

TEST(InterfaceNumbers, AreThoseOfTheCanonicalDeclarations) {
  const Generator generator("Generator");
  const InterfaceNumbers numbers("Generator", component::interface_of(generator));
  std::vector<std::string> declarations;
  for (const ride::Declaration& one : numbers.interface().declarations) {
    declarations.emplace_back(one.canonical);
  }
  EXPECT_THAT(declarations,
              testing::UnorderedElementsAre(
                  "void moveTo(Array<double>,double)", "void cancel_moveTo()",
                  "event moveTo_progress{double}", "int probe(float)", "event Reached{int,bool}",
                  "event Position{unsigned long,long,double}", "void Wish(Array<double>)"));
  EXPECT_EQ(numbers.interface().name, "Generator");
  EXPECT_EQ(numbers.number(NumberedMember::Kind::kCommand, 0), 0xd53a44a9u);  // docs/ride.md
  ASSERT_NE(numbers.find(0xd53a44a9u), nullptr);
  EXPECT_EQ(numbers.find(0xd53a44a9u)->kind, NumberedMember::Kind::kCommand);
  EXPECT_EQ(numbers.find(1u), nullptr);
}

TEST(InterfaceNumbers, SayWhoMayUseThem) {
  const Generator generator("Generator");
  const InterfaceNumbers numbers("Generator", component::interface_of(generator));
  for (const ride::Declaration& one : numbers.interface().declarations) {
    EXPECT_EQ(one.access, one.is_event() ? ride::Access::kRead : ride::Access::kCommand);
  }
}

}  // namespace
}  // namespace armature::remote
