// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "armature/document/fields.hpp"
#include "tests/edit/every_deployment.hpp"

namespace armature::edit::tests {
namespace {

using document::Document;

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

TEST_F(EveryDeployment, GetsAndLosesSuperiors) {
  each([&](const Document& document, const SourceMap& map) {
    for (const Entry& entry : entries_to_try(map)) {
      if (find(document, entry.names.front()) == nullptr || !entry.composite.empty()) continue;
      const std::string superior = document.components.back().name;
      const AddSuperior add{written(entry), superior};
      try_edit(add, [&](auto& before, const Document& after, Tree tree) {
        const auto& peers = find(after, entry.names.front())->peers;
        EXPECT_TRUE(std::ranges::any_of(
            peers, [&](const auto& peer) { return peer.superior && peer.component == superior; }));
        const Edit remove{RemoveSuperior{add.component, superior}, files_of(deployment())};
        const Outcome back = apply_edits(deployment(), {remove}, tree.reader());
        ASSERT_TRUE(back.ok()) << back.diagnostics.to_text();
        tree.apply(back);
        EXPECT_EQ(yaml(tree.load(deployment())), yaml(before));
      });
    }
  });
  EXPECT_GT(made(), 300u);
  EXPECT_LT(refused(), made() / 4) << reasons();
}

TEST_F(EveryDeployment, CallsWhatItIsToldAndThenNothing) {
  each([&](const Document& document, const SourceMap& map) {
    for (const Entry& entry : entries_to_try(map)) {
      const auto* component = find(document, entry.names.front());
      if (component == nullptr || !entry.composite.empty() || !component->calls.empty()) continue;
      const std::string other = document.components.back().name;
      const SetCalls set{written(entry),
                         "[" + other + ".go, {call: " + other + ".turn, with: {by: 2 rad}}]"};
      try_edit(set, [&](auto& before, const Document& after, Tree tree) {
        for (const std::string& name : entry.names) EXPECT_EQ(find(after, name)->calls.size(), 2u);
        const Edit none{SetCalls{set.component, "[]"}, files_of(deployment())};
        const Outcome back = apply_edits(deployment(), {none}, tree.reader());
        ASSERT_TRUE(back.ok()) << back.diagnostics.to_text();
        tree.apply(back);
        EXPECT_EQ(yaml(tree.load(deployment())), yaml(before));
      });
    }
  });
  EXPECT_GT(made(), 300u);
  EXPECT_LT(refused(), made() / 10) << reasons();
}

TEST_F(EveryDeployment, IncludesAFileAndDoesSoNoLonger) {
  std::size_t taken_out = 0;
  each([&](const Document&, const SourceMap& map) {
    Tree tree;
    const auto reader = [read = tree.reader()](const std::string& path) {
      const bool added = path.ends_with("added_by_a_test.yaml");
      return added ? base::Result<std::string>("components: {Newcomer: {model: Watcher}}\n")
                   : read(path);
    };
    const std::string file = "added_by_a_test.yaml";
    const Outcome added = apply_edits(deployment(), {{AddInclude{file}}}, reader);
    ASSERT_TRUE(added.ok()) << deployment() << added.diagnostics.to_text();
    const Outcome both =
        apply_edits(deployment(), {{AddInclude{file}}, {RemoveInclude{file}}}, reader);
    ASSERT_TRUE(both.ok()) << deployment() << both.diagnostics.to_text();
    for (const Node* item : items_of(find_value(map.main().root(), "include"))) {
      const Outcome out = apply_edits(deployment(), {{RemoveInclude{item->text}}}, reader);
      EXPECT_TRUE(out.ok() || out.diagnostics.to_text().find(" is refused: ") != std::string::npos);
      taken_out += out.ok() ? 1 : 0;
    }
  });
  EXPECT_GT(taken_out, 10u);
}

}  // namespace
}  // namespace armature::edit::tests
