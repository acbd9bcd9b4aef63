// SPDX-License-Identifier: Apache-2.0
#include "armature/edit/edit.hpp"

namespace armature::edit {
namespace {

std::string text_of(const Set& one) { return "set " + one.path; }
std::string text_of(const Unset& one) { return "unset " + one.path; }
std::string text_of(const AddComponent& one) { return "add " + one.name; }
std::string text_of(const RemoveComponent& one) { return "remove " + one.name; }
std::string text_of(const Rename& one) { return "rename " + one.from + " to " + one.to; }
std::string text_of(const Split& one) { return "split " + one.name + " at " + one.part; }
std::string text_of(const Group& one) { return "group " + one.name; }
std::string text_of(const Dissolve& one) { return "dissolve " + one.name; }
std::string text_of(const Connect& one) { return "connect " + one.from + " -> " + one.to; }
std::string text_of(const Disconnect& one) {
  return "disconnect " + one.from + (one.to.empty() ? "" : " -> " + one.to);
}
std::string text_of(const SetConnection& one) {
  return "set connection " + one.from + " -> " + one.to;
}
std::string text_of(const Bind& one) { return "bind " + one.component + "." + one.name; }
std::string text_of(const Unbind& one) { return "unbind " + one.component + "." + one.name; }
std::string text_of(const AddPeer& one) { return "peer " + one.peer + " of " + one.component; }
std::string text_of(const RemovePeer& one) {
  return "remove peer " + one.peer + " of " + one.component;
}
std::string text_of(const AddSuperior& one) {
  return "superior " + one.superior + " of " + one.component;
}
std::string text_of(const RemoveSuperior& one) {
  return "remove superior " + one.superior + " of " + one.component;
}
std::string text_of(const SetCalls& one) { return "set calls of " + one.component; }
std::string text_of(const AddInclude& one) { return "include " + one.file; }
std::string text_of(const RemoveInclude& one) { return "remove include " + one.file; }
std::string text_of(const AddParameter& one) { return "add parameter " + one.name; }
std::string text_of(const AddLibrary& one) { return "add library " + one.name; }
std::string text_of(const RemoveLibrary& one) { return "remove library " + one.name; }
std::string text_of(const AddToMode& one) { return "mode " + one.mode + " of " + one.component; }
std::string text_of(const RemoveFromMode& one) {
  return "remove " + one.component + " from mode " + one.mode;
}
std::string text_of(const RemoveMode& one) { return "remove mode " + one.name; }
std::string text_of(const StartInMode& one) { return "start in mode " + one.name; }
std::string text_of(const RenameMode& one) { return "rename mode " + one.from + " to " + one.to; }

}  // namespace

std::string to_text(const Change& change) {
  return std::visit([](const auto& one) { return text_of(one); }, change);
}

}  // namespace armature::edit
