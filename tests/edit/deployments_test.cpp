// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "armature/document/fields.hpp"
#include "tests/edit/tree.hpp"

namespace armature::edit::tests {
namespace {

using document::Document;

/// Makes edits on each deployment, and counts which of them are made and which are refused.
class EveryDeployment : public testing::Test {
 protected:
  using Edits = std::vector<Change>;
  using Check =
      std::function<void(const Document& before, const Document& after, const Tree& tree)>;

  /// @param visit  called with the document and its places
  void each(const std::function<void(const Document&, const SourceMap&)>& visit) {
    for (const std::string& deployment : Tree::deployments()) {
      deployment_ = deployment;
      files_ = files_of(deployment);
      Tree tree;
      base::Diagnostics diagnostics;
      const Document document = tree.load(deployment);
      const SourceMap map(deployment, tree.reader(), document, diagnostics);
      ASSERT_TRUE(diagnostics.ok());
      visit(document, map);
    }
  }

  /// Makes one edit where it stands. If it is made, looks at what has become of the document.
  void try_edit(const Change& change, const Check& check) {
    SCOPED_TRACE(deployment_ + ": " + to_text(change));
    Tree tree;
    const Outcome outcome = apply_edits(deployment_, {{change, files_}}, tree.reader());
    if (!outcome.ok()) {
      EXPECT_TRUE(outcome.files.empty());
      const std::string why = outcome.diagnostics.to_text();
      EXPECT_NE(why.find(" is refused: "), why.npos) << why;
      reasons_.insert(why);
      ++refused_;
      return;
    }
    ++made_;
    const Document before = tree.load(deployment_);
    check_replacements(outcome, tree);
    tree.apply(outcome);
    check(before, tree.load(deployment_), tree);
    tree.undo(outcome);
    for (const FileChange& file : outcome.files) EXPECT_EQ(tree.text(file.file), file.before);
  }

  /// Of a file that several deployments include, the entries are tried in the first of them.
  std::vector<Entry> entries_to_try(const SourceMap& map) {
    std::vector<Entry> entries = entries_of(map);
    std::erase_if(entries, [&](const Entry& entry) {
      return entry.file != &map.main() &&
             !tried_.emplace(entry.file->path(), entry.key->begin).second;
    });
    return entries;
  }

  const std::string& deployment() const { return deployment_; }
  std::size_t made() const { return made_; }
  std::size_t refused() const { return refused_; }
  std::string reasons() const {
    std::string all;
    for (const std::string& reason : reasons_) all += reason + "\n";
    return all;
  }

 private:
  void TearDown() override {
    RecordProperty("made", static_cast<int>(made_));
    RecordProperty("refused", static_cast<int>(refused_));
  }
  std::string deployment_;
  std::vector<std::string> files_;
  std::size_t made_ = 0;
  std::size_t refused_ = 0;
  std::set<std::string> reasons_;
  std::set<std::pair<std::string, std::size_t>> tried_;
};

const document::Component* find(const Document& document, const std::string& name) {
  for (const auto& component : document.components) {
    if (component.name == name) return &component;
  }
  return nullptr;
}

std::string written(const Entry& entry) {
  return (entry.composite.empty() ? "" : entry.composite + ".") + entry.key->text;
}

/// As the command line would set it, independently of the edit.
std::vector<std::string> settings(const Entry& entry, const std::string& rest) {
  std::vector<std::string> all;
  for (const std::string& name : entry.names) all.push_back(name + "." + rest);
  return all;
}

TEST_F(EveryDeployment, SetsAPropertyThatIsThere) {
  each([&](const Document& document, const SourceMap& map) {
    for (const Entry& entry : entries_to_try(map)) {
      const auto* component = find(document, entry.names.front());
      if (component == nullptr || component->properties.empty()) continue;
      const std::string name = component->properties.front().name;
      try_edit(Set{written(entry) + "." + name, "17.5"}, [&](auto&, auto& after, const Tree&) {
        Tree untouched;
        EXPECT_EQ(yaml(after), yaml(untouched.load(deployment(), settings(entry, name + "=17.5"))));
      });
    }
  });
  EXPECT_GT(made(), 150u);
  EXPECT_LT(refused(), made() / 10) << reasons();
}

TEST_F(EveryDeployment, SetsANewProperty) {
  each([&](const Document&, const SourceMap& map) {
    for (const Entry& entry : entries_to_try(map)) {
      const std::string set = "NewOne=[1, {a: \"${b}\"}]";
      try_edit(Set{written(entry) + ".NewOne", "[1, {a: !literal \"${b}\"}]"},
               [&](auto&, auto& after, const Tree&) {
                 Tree untouched;
                 EXPECT_EQ(yaml(after), yaml(untouched.load(deployment(), settings(entry, set))));
               });
    }
  });
  EXPECT_GT(made(), 300u);
  EXPECT_LT(refused(), made() / 10) << reasons();
}

TEST_F(EveryDeployment, SetsAnActivity) {
  each([&](const Document&, const SourceMap& map) {
    for (const Entry& entry : entries_to_try(map)) {
      try_edit(Set{written(entry) + ".activity", "{periodic: 33 ms, priority: 7}"},
               [&](auto&, const Document& after, const Tree&) {
                 for (const std::string& name : entry.names) {
                   const auto& activity = find(after, name)->activity;
                   EXPECT_EQ(activity.period, std::chrono::milliseconds(33));
                   EXPECT_EQ(activity.priority, 7);
                 }
               });
    }
  });
  EXPECT_GT(made(), 300u);
  EXPECT_LT(refused(), made() / 10) << reasons();
}

TEST_F(EveryDeployment, UnsetsAProperty) {
  each([&](const Document& document, const SourceMap& map) {
    for (const Entry& entry : entries_to_try(map)) {
      const auto* component = find(document, entry.names.front());
      if (component == nullptr || component->properties.empty()) continue;
      const document::Property property = component->properties.back();
      try_edit(Unset{written(entry) + "." + property.name},
               [&](const Document& before, const Document& after, const Tree&) {
                 EXPECT_EQ(before.components.size(), after.components.size());
                 for (const std::string& name : entry.names) {
                   const auto* rest = document::find(find(after, name)->properties, property.name);
                   EXPECT_TRUE(rest == nullptr || rest->where != property.where);
                 }
               });
    }
  });
  EXPECT_GT(made(), 150u);
  EXPECT_LT(refused(), made() / 10) << reasons();
}

TEST_F(EveryDeployment, AddsAComponent) {
  each([&](const Document&, const SourceMap&) {
    try_edit(AddComponent{"Newcomer", "Watcher"}, [&](auto& before, auto& after, const Tree&) {
      ASSERT_NE(find(after, "Newcomer"), nullptr);
      EXPECT_EQ(find(after, "Newcomer")->model, "Watcher");
      EXPECT_EQ(after.components.size(), before.components.size() + 1);
    });
  });
  EXPECT_EQ(made(), Tree::deployments().size());
}

TEST_F(EveryDeployment, RemovesAComponent) {
  each([&](const Document&, const SourceMap& map) {
    for (const Entry& entry : entries_to_try(map)) {
      try_edit(RemoveComponent{written(entry)}, [&](auto&, const Document& after, const Tree&) {
        for (const std::string& name : entry.names) {
          EXPECT_EQ(find(after, name), nullptr);
          for (const auto& one : after.connections) {
            EXPECT_NE(one.from.component, name);
            EXPECT_NE(one.to.component, name);
          }
          for (const auto& one : after.components) {
            for (const auto& peer : one.peers) EXPECT_NE(peer.component, name);
          }
        }
      });
    }
  });
  EXPECT_GT(made(), 300u);
  EXPECT_LT(refused(), made() / 10) << reasons();
}

TEST_F(EveryDeployment, RenamesAComponentAndBack) {
  each([&](const Document&, const SourceMap& map) {
    for (const Entry& entry : entries_to_try(map)) {
      const std::string name = written(entry);
      const std::size_t at = entry.composite.empty() ? 0 : entry.composite.size() + 1;
      const std::string other = name.substr(0, at) + "New" + name.substr(at);
      try_edit(Rename{name, other}, [&](auto& before, auto& after, Tree tree) {
        EXPECT_NE(yaml(before), yaml(after));
        EXPECT_EQ(find(after, entry.names.front()), nullptr);
        const Outcome back = apply_edits(
            deployment(), {{Rename{other, name}, files_of(deployment())}}, tree.reader());
        ASSERT_TRUE(back.ok()) << back.diagnostics.to_text();
        Tree untouched;
        for (const FileChange& file : back.files) EXPECT_EQ(file.after, untouched.text(file.file));
      });
    }
  });
  EXPECT_GT(made(), 300u);
  EXPECT_LT(refused(), made() / 10) << reasons();
}

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

TEST_F(EveryDeployment, ConnectsAndDisconnects) {
  each([&](const Document& document, const SourceMap&) {
    const auto is_part = [](const auto& one) { return one.name.find('.') != std::string::npos; };
    std::vector<document::Component> own = document.components;
    std::erase_if(own, is_part);
    if (own.empty()) return;
    const std::string from = own.front().name;
    const std::string to = own.back().name;
    const Connect connect{from + ".NewOut", to + ".NewIn", "policy: {fifo: 8}, max_age: 30 ms"};
    try_edit(connect, [&](auto& before, const Document& after, Tree tree) {
      ASSERT_EQ(after.connections.size(), before.connections.size() + 1);
      const Disconnect disconnect{connect.from, connect.to};
      const Outcome back = apply_edits(deployment(), {{disconnect, {}}}, tree.reader());
      ASSERT_TRUE(back.ok()) << back.diagnostics.to_text();
      tree.apply(back);
      EXPECT_EQ(yaml(tree.load(deployment())), yaml(before));
    });
  });
  EXPECT_GT(made(), 100u);
  EXPECT_EQ(refused(), 0u) << reasons();
}

/// The ends of a connection as its file has them.
Disconnect as_written(const Node& item) {
  const auto end = [&](const char* key, const char* other) {
    const Node* value = find_value(&item, key);
    return value != nullptr ? value->text : find_value(&item, other)->text;
  };
  if (item.kind == Node::Kind::kMap) return {end("from", "on"), end("to", "do")};
  const std::size_t arrow = item.text.find(" -> ");
  return {item.text.substr(0, arrow), item.text.substr(arrow + 4)};
}

TEST_F(EveryDeployment, DisconnectsWhatIsThere) {
  each([&](const Document& document, const SourceMap& map) {
    std::map<const ConnectionEntry*, std::size_t> made_of;
    for (const auto& one : document.connections) ++made_of[map.entry_of(one)];
    for (const auto& [entry, count] : made_of) {
      if (entry == nullptr) continue;
      try_edit(as_written(*entry->item), [&](auto& before, const Document& after, const Tree&) {
        EXPECT_EQ(after.connections.size(), before.connections.size() - count);
      });
    }
  });
  EXPECT_GT(made(), 800u);
  EXPECT_LT(refused(), 10u) << reasons();
}

TEST_F(EveryDeployment, DisconnectsOneOfARangeByAnOverride) {
  std::size_t made = 0;
  each([&](const Document& document, const SourceMap& map) {
    std::set<const ConnectionEntry*> done;
    for (const auto& one : document.connections) {
      const ConnectionEntry* entry = map.entry_of(one);
      if (entry == nullptr || !entry->composite.empty() || !done.insert(entry).second) continue;
      const Disconnect disconnect{document::to_text(one.from), document::to_text(one.to)};
      Tree tree;
      const Outcome outcome = apply_edits(deployment(), {{disconnect, {}, true}}, tree.reader());
      if (!outcome.ok()) continue;  // an end that a composite exports has another name
      tree.apply(outcome);
      EXPECT_EQ(tree.load(deployment()).connections.size(), document.connections.size() - 1);
      ++made;
    }
  });
  EXPECT_GT(made, 700u);
}

TEST_F(EveryDeployment, OverridesWhatIncludedFilesAndRangesSay) {
  std::size_t made = 0;
  each([&](const Document& document, const SourceMap& map) {
    for (const Entry& entry : entries_of(map)) {
      if (!entry.composite.empty() || find(document, entry.names.back()) == nullptr) continue;
      const std::string path = entry.names.back() + ".NewOne";
      Tree tree;
      const Outcome outcome =
          apply_edits(deployment(), {{Set{path, "1 m"}, {}, true}}, tree.reader());
      ASSERT_TRUE(outcome.ok()) << deployment() << outcome.diagnostics.to_text();
      ASSERT_EQ(outcome.files.size(), 1u);
      EXPECT_EQ(outcome.files[0].file, deployment());
      tree.apply(outcome);
      Tree untouched;
      EXPECT_EQ(yaml(tree.load(deployment())), yaml(untouched.load(deployment(), {path + "=1 m"})));
      ++made;
    }
  });
  EXPECT_GT(made, 500u);
}

TEST_F(EveryDeployment, GetsAndLosesPeersAndLibraries) {
  each([&](const Document& document, const SourceMap& map) {
    for (const Entry& entry : entries_to_try(map)) {
      if (find(document, entry.names.front()) == nullptr || !entry.composite.empty()) continue;
      const std::string peer = document.components.back().name;
      try_edit(AddPeer{written(entry), peer}, [&](auto& before, const Document& after, Tree tree) {
        EXPECT_EQ(find(after, entry.names.front())->peers.back().component, peer);
        const Edit remove{RemovePeer{written(entry), peer}, files_of(deployment())};
        const Outcome back = apply_edits(deployment(), {remove}, tree.reader());
        ASSERT_TRUE(back.ok()) << back.diagnostics.to_text();
        tree.apply(back);
        EXPECT_EQ(yaml(tree.load(deployment())), yaml(before));
      });
    }
    try_edit(AddLibrary{"another"}, [&](auto&, const Document& after, const Tree&) {
      const auto is_it = [](const auto& library) { return library.name == "another"; };
      EXPECT_TRUE(std::any_of(after.libraries.begin(), after.libraries.end(), is_it));
    });
  });
  EXPECT_GT(made(), 300u);
  EXPECT_LT(refused(), made() / 4) << reasons();
}

}  // namespace
}  // namespace armature::edit::tests
