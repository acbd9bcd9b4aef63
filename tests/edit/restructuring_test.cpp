// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "armature/document/fields.hpp"
#include "tests/edit/every_deployment.hpp"

namespace armature::edit::tests {
namespace {

using document::Document;

TEST_F(EveryDeployment, SplitsARangeAndChangesNothing) {
  each([&](const Document&, const SourceMap& map) {
    for (const Entry& entry : entries_to_try(map)) {
      if (entry.key->text.find("..") == std::string::npos || entry.names.size() < 2) continue;
      for (const char* part : {"1", "2", "2..3"}) {
        try_edit(Split{written(entry), part}, [&](auto& before, auto& after, Tree tree) {
          EXPECT_EQ(yaml(before), yaml(after));
          base::Diagnostics ignored;
          const SourceMap anew(deployment(), tree.reader(), after, ignored);
          EXPECT_GT(anew.entries().size(), map.entries().size());
        });
      }
    }
  });
  EXPECT_GT(made(), 20u);
  EXPECT_LT(refused(), made()) << reasons();
}

/// With its connections in one order: those inside of composites come first in a document.
std::string sorted_yaml(Document document) {
  std::ranges::sort(document.connections, std::less<>(), [](const document::Connection& one) {
    return document::to_text(one.from) + document::to_text(one.to);
  });
  return yaml(document);
}

/// With the names that its components had before they were grouped, independently of the edit.
Document ungrouped(Document document) {
  const auto strip = [](std::string& name) {
    if (name.starts_with("Grouped.")) name.erase(0, std::string("Grouped.").size());
  };
  std::erase_if(document.composites, [](const auto& one) { return one.name == "Grouped"; });
  for (auto& one : document.components) {
    strip(one.name);
    for (auto& peer : one.peers) strip(peer.component);
    for (auto& peer : one.peers) strip(peer.name);
    for (auto& bound : one.bindings) strip(bound.component);
    for (auto& delay : one.delays) strip(delay.name);
  }
  for (auto* all : {&document.connections, &document.operator_inputs, &document.network.inputs}) {
    for (auto& one : *all) {
      strip(one.from.component);
      strip(one.to.component);
      for (auto& parameter : one.with) strip(parameter.value.text);
    }
  }
  for (auto& one : document.named_connections) {
    for (auto& port : one.ports) strip(port.component);
  }
  for (auto& one : document.composites) {
    strip(one.name);
    for (auto& shown : one.exports) strip(shown.component);
  }
  for (auto* all : {&document.script_grants, &document.remote_grants, &document.before_stop}) {
    for (auto& one : *all) strip(one.component);
  }
  for (auto& mode : document.modes) {
    for (auto& one : mode.components) strip(one.name);
  }
  return document;
}

TEST_F(EveryDeployment, GroupsComponentsAndDissolvesThem) {
  each([&](const Document&, const SourceMap& map) {
    const std::vector<Entry> entries = entries_to_try(map);
    for (std::size_t i = 0; i + 1 < entries.size(); ++i) {
      const Group group{"Grouped", {written(entries[i]), written(entries[i + 1])}};
      try_edit(group, [&](const Document& before, const Document& after, Tree tree) {
        const Outcome back = apply_edits(
            deployment(), {{Dissolve{"Grouped"}, files_of(deployment())}}, tree.reader());
        ASSERT_TRUE(back.ok()) << back.diagnostics.to_text();
        tree.apply(back);
        EXPECT_EQ(sorted_yaml(tree.load(deployment())), sorted_yaml(before));
        EXPECT_EQ(sorted_yaml(ungrouped(after)), sorted_yaml(before));
      });
    }
  });
  EXPECT_GT(made(), 50u) << reasons();
}

TEST_F(EveryDeployment, DissolvesWhatIsAComposite) {
  each([&](const Document& document, const SourceMap&) {
    for (const document::Composite& composite : document.composites) {
      if (composite.name.find('.') != std::string::npos) continue;
      try_edit(Dissolve{composite.name}, [&](auto& before, const Document& after, const Tree&) {
        EXPECT_EQ(after.components.size(), before.components.size());
        EXPECT_EQ(after.connections.size(), before.connections.size());
        EXPECT_EQ(after.composites.size() + 1, before.composites.size());
      });
    }
  });
  EXPECT_GT(made(), 2u) << reasons();
}

}  // namespace
}  // namespace armature::edit::tests
