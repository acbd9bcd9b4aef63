// SPDX-License-Identifier: Apache-2.0
#include "armature/generate/internal/refusals.hpp"

#include <string>
#include <string_view>

#include "armature/component/interface.hpp"
#include "armature/component/operations/operation.hpp"
#include "armature/component/properties/property.hpp"
#include "armature/document/value_tree.hpp"

namespace armature::generate::internal {
namespace {

using document::in_quotes;

constexpr const char* kRunInstead = "run this deployment with armature run, or make a bundle of it";

const component::PropertyBase* find_property(const component::Component& component,
                                             std::string_view name) {
  for (const component::PropertyBase* property : component::interface_of(component).properties) {
    if (property->name() == name) return property;
  }
  return nullptr;
}

const component::Component* find_component(const exec::Blueprint& blueprint,
                                           std::string_view name) {
  for (const exec::ComponentEntry& entry : blueprint.components) {
    if (entry.component->name() == name) return entry.component.get();
  }
  return nullptr;
}

void refuse_component(const document::Component& written, base::Diagnostics& diagnostics) {
  if (!written.remote.name.empty()) {
    diagnostics.error(written.remote.where,
                      in_quotes(written.name) +
                          " lives in another process, and a generated program connects to none",
                      kRunInstead);
  }
  if (written.autosave) {
    diagnostics.error(written.where,
                      in_quotes(written.name) +
                          " saves its properties (autosave), and a generated program has no "
                          "property files",
                      "leave out autosave, or " + std::string(kRunInstead));
  }
  if (written.model == "TaskBrowser") {
    diagnostics.error(written.model_where,
                      in_quotes(written.name) +
                          " stands for the operator's prompt, which a generated program has not",
                      "remove it, or " + std::string(kRunInstead));
  }
}

/// It counts once; compiled in it would count for ever.
void refuse_operators_words(const document::Component& written,
                            const component::Component& component,
                            base::Diagnostics& diagnostics) {
  for (const document::Property& given : written.properties) {
    const component::PropertyBase* const property = find_property(component, given.name);
    if (property == nullptr || !property->is_by_operator()) continue;
    diagnostics.error(given.where,
                      in_quotes(written.name + "." + given.name) +
                          " is the operator's word, which counts for one run: a generated program "
                          "would say it in each",
                      "leave it out");
  }
}

void refuse_network(const document::Document& document, base::Diagnostics& diagnostics) {
  const document::Network& network = document.network;
  for (const document::Reference& address : network.listen) {
    diagnostics.error(address.where,
                      "the application listens at " + in_quotes(address.name) +
                          ", and a generated program serves no other processes",
                      kRunInstead);
  }
  for (const document::Connection& input : network.inputs) {
    diagnostics.error(input.where,
                      in_quotes(to_text(input.to)) +
                          " is written by other processes, and a generated program serves none",
                      kRunInstead);
  }
  for (const document::Connection& input : document.operator_inputs) {
    diagnostics.error(input.where,
                      in_quotes(to_text(input.to)) +
                          " is written by the operator, who has no tool for a generated program",
                      kRunInstead);
  }
}

void tell_grants(const std::vector<document::OperationOf>& grants, std::string_view whom,
                 base::Diagnostics& diagnostics) {
  if (grants.empty()) return;
  diagnostics.note(grants.front().where, "grants for " + std::string(whom) +
                                             " have no effect in a generated program, which " +
                                             "serves none");
}

/// Nobody arms a robot of a generated program.
void tell_operators_acts(const exec::Blueprint& blueprint, base::Diagnostics& diagnostics) {
  for (const exec::ComponentEntry& entry : blueprint.components) {
    for (const component::OperationBase* operation :
         component::interface_of(*entry.component).operations) {
      if (!operation->is_by_operator()) continue;
      diagnostics.note(entry.where,
                       in_quotes(entry.component->name() + "." + std::string(operation->name())) +
                           " is an act of the operator, who has no tool for a generated program: "
                           "it is never done there");
    }
  }
}

}  // namespace

void refuse_what_needs_tools(const deploy::Deployment& deployment,
                             base::Diagnostics& diagnostics) {
  const document::Document& document = deployment.document;
  for (const document::Component& written : document.components) {
    refuse_component(written, diagnostics);
    const component::Component* const made = find_component(deployment.blueprint, written.name);
    if (made != nullptr) refuse_operators_words(written, *made, diagnostics);
  }
  refuse_network(document, diagnostics);
  tell_grants(document.script_grants, "scripts", diagnostics);
  tell_grants(document.remote_grants, "other processes", diagnostics);
  tell_operators_acts(deployment.blueprint, diagnostics);
}

}  // namespace armature::generate::internal
