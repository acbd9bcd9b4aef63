// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <utility>
#include <vector>

#include "armature/record/cdr.hpp"
#include "armature/record/ros_types.hpp"
#include "armature/types/elements.hpp"

namespace armature::record {
namespace {

using types::Field;
using types::Kind;
using types::Type;

constexpr std::string_view kPackage = "armature_msgs";
constexpr const char* kDataMember = "data";  ///< as messages of std_msgs have it

/// What ROS has itself; Foxglove's own schemas are not among them.
std::string package_of(const Type& type) {
  const std::array<std::pair<const Type*, const char*>, 8> own{
      {{&types::type_of<ros::Time>(), "builtin_interfaces"},
       {&types::type_of<ros::Header>(), "std_msgs"},
       {&types::type_of<ros::Vector3>(), "geometry_msgs"},
       {&types::type_of<ros::Quaternion>(), "geometry_msgs"},
       {&types::type_of<ros::Transform>(), "geometry_msgs"},
       {&types::type_of<ros::TransformStamped>(), "geometry_msgs"},
       {&types::type_of<ros::TFMessage>(), "tf2_msgs"},
       {&types::type_of<ros::JointState>(), "sensor_msgs"}}};
  for (const auto& [known, package] : own) {
    if (types::same_type(type, *known)) return package;
  }
  const bool standard =
      types::is_text(type) || (types::is_scalar(type) && type.kind != Kind::kEnum);
  return standard ? "std_msgs" : std::string(kPackage);
}

/// `Float64`, `Pose`, `Float64List`, `PoseArray3`.
std::string message_name(const Type& type) {
  if (types::is_text(type)) return "String";
  if (type.kind == Kind::kVector) return message_name(*type.element) + "List";
  if (type.kind == Kind::kArray) {
    return message_name(*type.element) + "Array" + std::to_string(type.count);
  }
  if (type.kind == Kind::kFloat) return "Float32";
  if (type.kind == Kind::kDouble) return "Float64";
  std::string name;
  for (const char one : type.name) {
    if (std::isalnum(static_cast<unsigned char>(one)) != 0) name += one;
  }
  const bool integer = name.starts_with("uint");
  if (integer) return "UInt" + name.substr(4);
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name[0])) != 0) name = "T" + name;
  name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
  return name;
}

std::string in_lower_case(std::string_view name) {
  std::string lower;
  for (const char one : name) {
    const auto byte = static_cast<unsigned char>(one);
    if (std::isupper(byte) != 0 && !lower.empty() && lower.back() != '_') lower += '_';
    lower += std::isalnum(byte) != 0 ? static_cast<char>(std::tolower(byte)) : '_';
  }
  if (lower.empty() || std::isalpha(static_cast<unsigned char>(lower[0])) == 0)
    lower = "f_" + lower;
  return lower;
}

std::string in_upper_case(const std::string& name) {
  std::string upper = in_lower_case(name);
  std::ranges::transform(upper, upper.begin(),
                         [](unsigned char one) { return static_cast<char>(std::toupper(one)); });
  return upper;
}

/// Writes a message and gathers those that are in it.
class Definitions {
 public:
  std::string whole(const Type& type) {
    std::string text = body_of(type);
    for (std::size_t i = 0; i < used_.size(); ++i) {
      const Type& used = *used_[i];
      text += std::string(80, '=') + "\nMSG: " + reference_to(used) + "\n" + body_of(used);
    }
    return text;
  }

 private:
  static std::string reference_to(const Type& type) {
    return package_of(type) + "/" + message_name(type);
  }

  std::string body_of(const Type& message) {
    std::string text;
    if (message.kind != Kind::kStruct) {
      return line_of({kDataMember, 0, &message, {}, {}}, kDataMember);
    }
    std::vector<std::string> names;
    for (const Field& field : message.fields) {
      std::string name = in_lower_case(field.name);
      while (std::ranges::count(names, name) > 0) name += "_2";
      text += line_of(field, name);
      names.push_back(std::move(name));
    }
    return text;
  }

  std::string line_of(const Field& field, const std::string& name) {
    std::string line;
    if (field.type->kind == Kind::kEnum) {
      for (const types::Enumerator& one : field.type->enumerators) {
        line += word_for(*field.type) + " " + in_upper_case(name + "_" + one.name) + "=" +
                std::to_string(one.value) + "\n";
      }
    }
    std::string comment(field.doc);
    if (!field.unit.empty())
      comment += (comment.empty() ? "[" : " [") + std::string(field.unit) + "]";
    std::ranges::replace(comment, '\n', ' ');
    line += word_for(*field.type) + " " + name;
    return line + (comment.empty() ? "\n" : "  # " + comment + "\n");
  }

  /// `float64`, `armature_msgs/Pose[3]`. ROS has no lists of lists.
  std::string word_for(const Type& type) {
    if (types::is_text(type)) return "string";
    if (type.kind == Kind::kEnum) return word_for(*type.underlying);
    if (types::is_list(type)) {
      const Type& element = *type.element;
      const std::string count = type.kind == Kind::kArray ? std::to_string(type.count) : "";
      return (types::is_list(element) ? use(element) : word_for(element)) + "[" + count + "]";
    }
    if (type.kind == Kind::kFloat) return "float32";
    if (type.kind == Kind::kDouble) return "float64";
    return type.kind == Kind::kStruct ? use(type) : type.name;
  }

  std::string use(const Type& type) {
    const auto same = [&](const Type* one) { return types::same_type(*one, type); };
    if (std::ranges::none_of(used_, same)) used_.push_back(&type);
    return reference_to(type);
  }

  std::vector<const Type*> used_;
};

}  // namespace

std::string ros2_name(const Type& type) { return package_of(type) + "/msg/" + message_name(type); }

std::string ros2_definition(const Type& type) { return Definitions().whole(type); }

}  // namespace armature::record
