// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "armature/types/type.hpp"

namespace armature::types::internal {

/// Reads the text form into a value, or only checks that it could if the value is nullptr.
class TextReader {
 public:
  explicit TextReader(std::string_view text) : rest_(text) {}

  bool read_whole(const Type& type, void* value);

  /// What is wrong, with the path of the part at fault; valid after a read returned false.
  const std::string& problem() const { return problem_; }

 private:
  bool read(const Type& type, void* value);
  bool read_scalar(const Type& type, void* value);
  bool read_enumerator(const Type& type, void* value);
  bool read_bool(void* value);
  template <typename T>
  bool read_number(const Type& type, void* value);
  bool read_quoted(const Type& type, void* value);
  bool read_escape(std::string& to);
  bool set_text(const Type& type, std::string_view text, void* value);
  bool read_list(const Type& list, void* value);
  bool read_element(const Type& list, void* value, std::size_t index);
  bool read_struct(const Type& type, void* value);
  const Field* read_field_name(const Type& type);
  bool check_complete(const Type& type, const std::vector<char>& given);

  void skip_space();
  bool take(char wanted);
  std::string_view take_word();
  bool fail(const std::string& what);
  bool fail_expecting(const std::string& expected);

  std::string_view rest_;
  std::string path_;
  std::string problem_;
};

}  // namespace armature::types::internal
