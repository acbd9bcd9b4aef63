// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pybind11/pybind11.h>

#include "armature/component/author.hpp"

namespace armature::python {

/// A property or port of a model in Python, as its class declares it.
struct Declared {
  std::string kind;  ///< `property`, `input` or `output`
  std::string name;
  std::string type;  ///< `bool`, `int`, `float`, `str`, `list`
  std::string unit;
  std::string doc;
  pybind11::object initial{};               ///< of a property
  std::optional<component::Range> range{};  ///< of a property
  bool changeable_while_running = false;    ///< of a property
  bool triggers = false;                    ///< of an input: what arrives runs `update`
  bool may_stay_open = false;               ///< of an input
  std::size_t size = 0;                     ///< of a list on a port
};

/// A model whose components are written in Python: a class, and what it declares.
struct Model {
  std::string name;
  std::string doc;
  pybind11::object made_by;
  std::vector<Declared> members;
};

/// The models of a deployment while this thread loads it. A registry knows functions without a
/// state only: so a deployment has 64 such classes at most, which no other load sees.
class ModelsOfLoad {
 public:
  using Models = std::vector<std::shared_ptr<const Model>>;

  explicit ModelsOfLoad(const Models& models);
  ModelsOfLoad(const ModelsOfLoad&) = delete;
  ModelsOfLoad& operator=(const ModelsOfLoad&) = delete;
  ~ModelsOfLoad();

  /// Components are made of them by this thread only, as long as this object lives.
  void add_to(component::Registry& registry) const;

 private:
  const Models& models_;
  const Models* outer_;  ///< of a load in which a component began this one
};

}  // namespace armature::python
