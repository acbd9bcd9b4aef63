// SPDX-License-Identifier: Apache-2.0
#include "armature/component/registry.hpp"

#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "armature/component/author.hpp"

namespace armature::component {
namespace {

using testing::ElementsAre;

class Pid : public Component {
 public:
  using Component::Component;
};

ARMATURE_COMPONENT_LIBRARY(motion, registry) { registry.add<Pid>("PID", "one-joint PID"); }

TEST(Registry, MakesComponentsOfItsModels) {
  Registry registry;
  registry.add<Pid>("PID", "one-joint PID");
  const Registry::Model* model = registry.find("PID");
  ASSERT_NE(model, nullptr);
  EXPECT_EQ(model->doc, "one-joint PID");
  EXPECT_EQ(model->library, "");
  const std::unique_ptr<Component> component = model->make("joint1.pid");
  EXPECT_EQ(component->name(), "joint1.pid");
  EXPECT_NE(dynamic_cast<Pid*>(component.get()), nullptr);
  EXPECT_EQ(registry.find("Pid"), nullptr) << "names are as they are written";
}

TEST(Registry, FindsAModelByItsFurtherNamesAndTellsTheNumberInOne) {
  Registry registry;
  registry.add<Pid>("PIDs", "", {{"Bank"}, {"PID#Bank", "joints"}});
  for (const char* name : {"PIDs", "Bank", "PID2Bank", "PID12Bank"}) {
    ASSERT_NE(registry.find(name), nullptr) << name;
    EXPECT_EQ(registry.find(name)->name, "PIDs");
  }
  EXPECT_EQ(registry.number_in("PID12Bank")->property, "joints");
  EXPECT_EQ(registry.number_in("PID12Bank")->value, "12");
  EXPECT_FALSE(registry.number_in("Bank"));
  EXPECT_FALSE(registry.number_in("PIDs"));
  for (const char* name : {"PIDBank", "PID0Bank", "PID02Bank", "PID-1Bank", "PID#Bank2", "PID2"}) {
    EXPECT_EQ(registry.find(name), nullptr) << name;
  }
  EXPECT_THAT(registry.names(), ElementsAre("PIDs"));
}

TEST(Registry, AModelSaysItsGranularityAndFace) {
  Registry registry;
  registry.add<Pid>("PID", "");
  registry.add<Pid>("Knob", "", drawn_as("slider"), Granularity::kAtomic);
  registry.add<Pid>("Tour", "", {{"Journey"}}, Granularity::kApplication);
  EXPECT_EQ(registry.find("PID")->granularity, Granularity::kAlgorithm);
  EXPECT_EQ(registry.find("PID")->face, "");
  EXPECT_EQ(registry.find("Knob")->granularity, Granularity::kAtomic);
  EXPECT_EQ(registry.find("Knob")->face, "slider");
  EXPECT_EQ(registry.find("Journey")->granularity, Granularity::kApplication);
}

TEST(Registry, AFurtherNameIsTakenToo) {
  Registry registry;
  registry.add<Pid>("PIDs", "", {{"Bank"}});
  registry.begin_library("motion");
  registry.add<Pid>("Bank", "");
  EXPECT_EQ(registry.end_library(),
            "model 'Bank' of library 'motion' exists already, in the program");
}

TEST(Registry, ListsItsModelsByName) {
  Registry registry;
  registry.add<Pid>("Sampler", "");
  registry.add<Pid>("Joint", "");
  registry.add<Pid>("PID", "");
  EXPECT_THAT(registry.names(), ElementsAre("Joint", "PID", "Sampler"));
}

TEST(Registry, ATakenNameIsRefusedNamingBothLibraries) {
  Registry registry;
  registry.begin_library("motion");
  registry.add<Pid>("PID", "the first");
  EXPECT_EQ(registry.end_library(), "");
  registry.begin_library("janus");
  registry.add<Pid>("PID", "the second");
  registry.add<Pid>("Other", "");
  EXPECT_EQ(registry.end_library(),
            "model 'PID' of library 'janus' exists already, in library 'motion'");
  EXPECT_EQ(registry.find("PID")->doc, "the first");
  EXPECT_EQ(registry.find("PID")->library, "motion");
  EXPECT_EQ(registry.find("Other")->library, "janus");
}

TEST(Registry, NamesEveryModelThatIsTaken) {
  Registry registry;
  registry.add<Pid>("PID", "");
  registry.add<Pid>("Joint", "");
  registry.begin_library("motion");
  registry.add<Pid>("PID", "");
  registry.add<Pid>("Joint", "");
  EXPECT_EQ(registry.end_library(),
            "model 'PID' of library 'motion' exists already, in the program; "
            "model 'Joint' of library 'motion' exists already, in the program");
}

TEST(Registry, TheProblemsOfOneLibraryAreNotThoseOfTheNext) {
  Registry registry;
  registry.add<Pid>("PID", "");
  registry.begin_library("motion");
  registry.add<Pid>("PID", "");
  EXPECT_NE(registry.end_library(), "");
  registry.begin_library("janus");
  registry.add<Pid>("Joint", "");
  EXPECT_EQ(registry.end_library(), "");
}

TEST(Registry, AddsModelsThatAreMadeElsewhere) {
  Registry registry;
  const auto make = [](std::string name) -> std::unique_ptr<Component> {
    return std::make_unique<Pid>(std::move(name));
  };
  EXPECT_TRUE(registry.add({"PID", "", "", make}));
  const auto refusal = registry.add({"PID", "", "motion", make});
  ASSERT_FALSE(refusal);
  EXPECT_EQ(refusal.error(), "model 'PID' of library 'motion' exists already, in the program");
}

TEST(Registry, ALibraryExportsOneFunctionThatFillsIt) {
  const LibraryDescription* library = armature_component_library();
  EXPECT_STREQ(library->name, "motion");
  EXPECT_STREQ(library->abi, abi_tag());
  EXPECT_EQ(library->layout, runtime_layout());
  Registry registry;
  registry.begin_library(library->name);
  library->fill(registry);
  EXPECT_EQ(registry.end_library(), "");
  EXPECT_EQ(registry.find("PID")->library, "motion");
}

struct Plain {
  int first;
  int second;
};
struct Larger {
  int first;
  int second;
  int third;
};
struct alignas(8) Aligned {
  int first;
  int second;
};

TEST(LayoutFingerprint, DiffersWithTheSizeOrAlignmentOfAnyType) {
  using internal::layout_of;
  const std::uint64_t layout = layout_of<Plain, double>();
  EXPECT_EQ((layout_of<Plain, double>()), layout);
  EXPECT_NE((layout_of<Larger, double>()), layout);
  EXPECT_NE((layout_of<Aligned, double>()), layout);
  EXPECT_NE((layout_of<Plain, float>()), layout);
  EXPECT_NE((layout_of<double, Plain>()), layout);
}

}  // namespace
}  // namespace armature::component
