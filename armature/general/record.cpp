// SPDX-License-Identifier: Apache-2.0
// The component library `record`: what a deployment records with, and the prompt.
#include "armature/component/registry.hpp"
#include "armature/general/reporter/reporter.hpp"
#include "armature/general/task_browser.hpp"

using namespace armature::general;
using armature::component::Granularity;

ARMATURE_COMPONENT_LIBRARY(record, registry) {
  registry.add<Reporter>("Reporter", "records ports, properties and components",
                         {{"FileReporting"}, {"ReportingComponent"}});
  registry.add<TaskBrowser>("TaskBrowser", "asks for the operator's prompt",
                            Granularity::kApplication);
}
