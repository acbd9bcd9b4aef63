// SPDX-License-Identifier: Apache-2.0
#include "tests/configurations/mutation.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "tests/configurations/mutation_kinds.hpp"

namespace armature::configurations {
namespace {

struct Kind {
  const char* name;
  Change change;
};

/// What is named twice happens twice as often.
const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{{"number", scale("number")},
                                     {"gain", scale("gain")},
                                     {"gain", scale("gain")},
                                     {"limit", scale("limit")},
                                     {"period", change_period},
                                     {"sign", change_sign},
                                     {"unit", change_unit},
                                     {"extreme", change_to_extreme},
                                     {"size", change_size},
                                     {"switch", change_switch},
                                     {"activity", change_activity},
                                     {"grant", change_grants},
                                     {"wire", change_wire},
                                     {"peer", change_peers},
                                     {"component", change_components},
                                     {"swap", swap_components},
                                     {"stop", change_stop},
                                     {"mode", change_modes},
                                     {"network", change_network},
                                     {"bus", change_bus}};
  return all;
}

}  // namespace

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_of_the_plant(const document::Component& component, const std::string& property) {
  if (property.starts_with("emulated")) return true;
  if (component.model == "SimulatedJanus") return property != "cards";
  return component.model == "Servo";
}

Mutation mutate(document::Document& document, Random& random) {
  while (true) {
    const Kind& kind = any_of(kinds(), random);
    document::Document changed = document;
    if (auto what = kind.change(changed, random)) {
      document = std::move(changed);
      return {kind.name, *what};
    }
  }
}

}  // namespace armature::configurations
