// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "armature/edit/internal/in_memory.hpp"

namespace armature::edit {
namespace {

using internal::edited;
using internal::Files;
using internal::refusal;

constexpr const char* kArm =
    "components:\n"
    "  Joint: {model: Joint, superiors: [Generator]}\n"
    "  Generator: {model: Generator, peers: [Joint]}\n"
    "  Other: {model: M}\n";

std::string with(const std::string& joint, const std::string& generator) {
  return "components:\n  Joint: {model: Joint" + joint + "}\n  Generator: {model: Generator" +
         generator + "}\n  Other: {model: M}\n";
}

TEST(EditSuperiors, AddsOneBesideOthersAndTheFirst) {
  EXPECT_EQ(edited(kArm, AddSuperior{"Joint", "Other"}),
            with(", superiors: [Generator, Other]", ", peers: [Joint]"));
  EXPECT_EQ(edited(kArm, AddSuperior{"Generator", "Other"}),
            with(", superiors: [Generator]", ", peers: [Joint], superiors: [Other]"));
}

TEST(EditSuperiors, TakesOneAndTheKeyOfTheLast) {
  EXPECT_EQ(edited(kArm, RemoveSuperior{"Joint", "Generator"}), with("", ", peers: [Joint]"));
  EXPECT_NE(refusal(kArm, RemoveSuperior{"Joint", "Generatr"})
                .find("'Joint' has no superior 'Generatr' (did you mean 'Generator'?)"),
            std::string::npos);
}

TEST(EditSuperiors, ArePeersOfAnotherKind) {
  EXPECT_EQ(edited(kArm, AddPeer{"Joint", "Other"}),
            with(", superiors: [Generator], peers: [Other]", ", peers: [Joint]"));
  EXPECT_NE(refusal(kArm, RemovePeer{"Joint", "Generator"}).find("has no peer 'Generator'"),
            std::string::npos);
  EXPECT_NE(refusal(kArm, AddSuperior{"Joint", "Nobody"}).find("unknown component 'Nobody'"),
            std::string::npos);
}

TEST(EditSuperiors, OverridesThoseOfAnIncludedFile) {
  const Files files = {{"robot.yaml", "include: part.yaml\n"}, {"part.yaml", kArm}};
  EXPECT_EQ(edited(files, {AddSuperior{"Joint", "Other"}, {}, true}),
            "include: part.yaml\ncomponents:\n"
            "  Joint: {override: true, superiors: [Generator, Other]}\n");
}

TEST(EditSuperiors, ChangesAnOverrideThatIsThere) {
  const Files files = {
      {"robot.yaml",
       "include: part.yaml\ncomponents:\n  Joint: {override: true, superiors: [Other]}\n"},
      {"part.yaml", kArm}};
  EXPECT_EQ(edited(files, {AddSuperior{"Joint", "Generator"}, {}, true}),
            "include: part.yaml\ncomponents:\n"
            "  Joint: {override: true, superiors: [Other, Generator]}\n");
}

}  // namespace
}  // namespace armature::edit
