// SPDX-License-Identifier: Apache-2.0
#include "armature/generate/internal/refusals.hpp"

#include <cstddef>
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

void refuse_component(const document::Component& written, base::Diagnostics& diagnostics) {
  if (!written.remote.name.empty()) {
    diagnostics.error(written.remote.where,
                      in_quotes(written.name) +
                          " lives in another process, and a generated program connects to none",
                      kRunInstead);
  }
  if (!written.calls.empty()) {
    diagnostics.error(written.calls.front().where,
                      in_quotes(written.name) +
                          " calls what the deployment names (calls), and a generated program names "
                          "nothing by text",
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

/// It counts once; compiled in it would count for ever. Its default says nothing.
void refuse_operators_words(const deploy::Deployment& deployment, const exec::ComponentEntry& entry,
                            base::Diagnostics& diagnostics) {
  const auto* const model = deployment.models.find(entry.model);
  if (model == nullptr) return;
  const auto fresh = model->make(entry.component->name());
  const auto& usual = component::interface_of(*fresh).properties;
  const auto& given = component::interface_of(*entry.component).properties;
  for (std::size_t i = 0; i < given.size() && i < usual.size(); ++i) {
    if (!given[i]->is_by_operator()) continue;
    const types::Type& type = given[i]->type();
    if (types::to_text(type, given[i]->data()) == types::to_text(type, usual[i]->data())) continue;
    diagnostics.error(entry.where,
                      in_quotes(entry.component->name() + "." + std::string(given[i]->name())) +
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

void refuse_what_needs_tools(const deploy::Deployment& deployment, base::Diagnostics& diagnostics) {
  const document::Document& document = deployment.document;
  for (const document::Component& written : document.components) {
    refuse_component(written, diagnostics);
  }
  for (const exec::ComponentEntry& entry : deployment.blueprint.components) {
    refuse_operators_words(deployment, entry, diagnostics);
  }
  refuse_network(document, diagnostics);
  tell_grants(document.script_grants, "scripts", diagnostics);
  tell_grants(document.remote_grants, "other processes", diagnostics);
  tell_operators_acts(deployment.blueprint, diagnostics);
}

}  // namespace armature::generate::internal
