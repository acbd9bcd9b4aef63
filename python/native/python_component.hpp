// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <pybind11/pybind11.h>

#include "armature/component/author.hpp"
#include "python/native/model.hpp"

namespace armature::python {

/// A property or port that an object in Python has.
class HostedMember {
 public:
  virtual ~HostedMember() = default;
  /// None: an input that nobody wrote yet.
  virtual pybind11::object get() = 0;
  virtual void set(pybind11::handle value) = 0;
};

/// A component whose hooks are those of an object in Python. It runs in simulated time only, in the
/// thread of who drives the application. What the object throws faults this component.
class PythonComponent final : public component::Component {
 public:
  PythonComponent(std::string name, std::shared_ptr<const Model> model);
  ~PythonComponent() override;

  void on_check(component::Check& check) const override;

  HostedMember& member(const std::string& name) const;
  double time_s() const;
  double period_s() const;
  void log(const std::string& level, const std::string& text);

 private:
  component::Outcome on_configure() override;
  component::Outcome on_start() override;
  void on_update() override;
  void on_stop() override;
  void on_cleanup() override;

  component::Outcome ask(const char* hook);
  void tell(const char* hook);
  /// What the object threw: in the log with where it was, and in a line.
  std::string note(pybind11::error_already_set& thrown);

  std::shared_ptr<const Model> model_;  ///< has the texts of the members
  std::map<std::string, std::unique_ptr<HostedMember>> members_;
  std::shared_ptr<PythonComponent*> self_;  ///< null once it is gone: the object may live longer
  pybind11::object object_;
};

}  // namespace armature::python
