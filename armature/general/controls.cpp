// SPDX-License-Identifier: Apache-2.0
// The component library `controls`: what applications are assembled with between components that
// do the work (paper 4, section III.C).
#include "armature/component/registry.hpp"
#include "armature/general/controls/adder.hpp"
#include "armature/general/controls/button.hpp"
#include "armature/general/controls/comparator.hpp"
#include "armature/general/controls/constant.hpp"
#include "armature/general/controls/deviation.hpp"
#include "armature/general/controls/displays.hpp"
#include "armature/general/controls/integrator.hpp"
#include "armature/general/controls/latch.hpp"
#include "armature/general/controls/limit.hpp"
#include "armature/general/controls/logic.hpp"
#include "armature/general/controls/multiplier.hpp"
#include "armature/general/controls/request.hpp"
#include "armature/general/controls/selector.hpp"
#include "armature/general/controls/sequence.hpp"
#include "armature/general/controls/slider.hpp"
#include "armature/general/controls/switch.hpp"
#include "armature/general/controls/timer.hpp"

using namespace armature::general;
using armature::component::drawn_as;
using armature::component::Granularity;

ARMATURE_COMPONENT_LIBRARY(controls, registry) {
  registry.add<Constant>("Constant", "writes a number");
  registry.add<Timer>("Timer", "raises an event each time that a period has passed");
  registry.add<Adder>("Adder", "adds its inputs, each with its sign");
  registry.add<Multiplier>("Multiplier", "multiplies its inputs");
  registry.add<Comparator>("Comparator", "tells when a value passes a threshold");
  registry.add<Deviation>("Deviation", "tells how far a shadow's number is from the driving one");
  registry.add<Deviations>("Deviations", "tells how far a shadow's list is from the driving one");
  registry.add<Selector>("Selector", "passes on one of its inputs");
  registry.add<Latch>("Latch", "passes on the last number that it was told");
  registry.add<Limit>("Limit", "keeps a value between two bounds");
  registry.add<Logic>("Logic", "combines truth values");
  registry.add<Integrator>("Integrator", "sums a value up over time");
  registry.add<Sequence>("Sequence", "does calls one after the other", Granularity::kApplication);
  registry.add<Request>("Request", "asks an operation and writes its result");
  registry.add<Button>("Button", "something to press", drawn_as("button"));
  registry.add<Switch>("Switch", "something to turn on and off", drawn_as("switch"));
  registry.add<Slider>("Slider", "a number that somebody moves", drawn_as("slider"));
  registry.add<Light>("Light", "shows whether something holds", drawn_as("light"));
  registry.add<Number>("Number", "shows a number", drawn_as("number"));
  registry.add<Text>("Text", "shows a text", drawn_as("text"));
  registry.add<Plot>("Plot", "shows how numbers went", drawn_as("plot"));
}
