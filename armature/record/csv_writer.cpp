// SPDX-License-Identifier: Apache-2.0
#include "armature/record/csv_writer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "armature/record/internal/json_text.hpp"
#include "armature/record/internal/seconds_text.hpp"

namespace armature::record {
namespace {

using types::Field;
using types::Kind;
using types::Type;

constexpr std::string_view kMissing = "nan";
constexpr std::size_t kBlock = 64u << 10;

bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

/// `Head.q[0]` as `Head_q_0`.
std::string plain_name(const std::string& full_name) {
  std::string name;
  for (const char c : full_name) {
    if (is_word(c)) {
      name += c;
    } else if (!name.empty() && name.back() != '_') {
      name += '_';
    }
  }
  while (!name.empty() && name.back() == '_') name.pop_back();
  return name.empty() ? "column" : name;
}

/// Comments have one line each.
std::string one_line(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

std::string cell(const Type& type, const void* value) {
  if (type.kind == Kind::kBool) return *static_cast<const bool*>(value) ? "1" : "0";
  if (type.kind == Kind::kEnum) return types::to_text(*type.underlying, value);
  return types::to_text(type, value);
}

struct Leaf {
  std::string path;
  std::string text;
  const Type* type;
};

/// `the gait (standing = 0, walking = 1)`: cells have numbers, for numpy.
std::string with_names(std::string doc, const Type& type) {
  for (const types::Enumerator& each : type.enumerators) {
    doc += &each == &type.enumerators.front() ? (doc.empty() ? "(" : " (") : ", ";
    doc += each.name + " = " + std::to_string(each.value);
  }
  return type.enumerators.empty() ? doc : doc + ")";
}

/// All but texts, which numpy takes for missing numbers.
std::vector<Leaf> number_leaves(const types::Value& value) {
  std::vector<Leaf> leaves;
  types::visit_leaves(value.type(), value.data(),
                      [&](const std::string& path, const Type& type, const void* leaf) {
                        if (!types::is_text(type))
                          leaves.push_back({path, cell(type, leaf), &type});
                      });
  return leaves;
}

/// The field that `path` leads to last, such as `q` of `legs[1].q[0]`; none without fields.
const Field* field_at(const Type& type, std::string_view path) {
  if (type.element != nullptr) {
    return field_at(*type.element, path.substr(std::min(path.find(']') + 1, path.size())));
  }
  if (path.starts_with('.')) path.remove_prefix(1);
  for (const Field& field : type.fields) {
    if (path.substr(0, path.find_first_of(".[")) != field.name) continue;
    const Field* const inner = field_at(*field.type, path.substr(field.name.size()));
    return inner != nullptr ? inner : &field;
  }
  return nullptr;
}

}  // namespace

base::Result<std::unique_ptr<CsvWriter>> CsvWriter::create(const std::string& path) {
  auto file = platform::OutputFile::create(path);
  if (!file) return base::Error{file.error()};
  return std::unique_ptr<CsvWriter>(new CsvWriter(std::move(file).value()));
}

CsvWriter::CsvWriter(platform::OutputFile file) : file_(std::move(file)), channels_(file_.path()) {
  add_column("time_s", "s", "");
}

CsvWriter::~CsvWriter() { static_cast<void>(CsvWriter::close().ok()); }

base::Result<void> CsvWriter::check_usable() const {
  if (failure_) return *failure_;
  if (closed_) return base::Error{"'" + file_.path() + "' is closed already"};
  return {};
}

base::Result<ChannelId> CsvWriter::add_channel(Channel channel) {
  auto usable = check_usable();
  if (!usable) return base::Error{usable.error()};
  if (names_.empty()) {
    return base::Error{"'" + file_.path() + "': channel '" + channel.name +
                       "' is expected before the first sample, but comes after it"};
  }
  auto id = channels_.add(std::move(channel));
  if (!id) return id;
  const Channel& added = channels_[id.value()];
  Columns columns;
  columns.first = row_.size();
  for (const Leaf& leaf : number_leaves(added.shape)) {
    const bool joined = leaf.path.empty() || leaf.path.starts_with('[');
    const Field* const field = field_at(added.shape.type(), leaf.path);
    add_column(added.name + (joined ? "" : ".") + leaf.path,
               field != nullptr ? std::string(field->unit) : added.unit,
               with_names(field != nullptr ? std::string(field->doc) : added.doc, *leaf.type));
    columns.paths.push_back(leaf.path);
  }
  if (columns.paths.empty()) comments_ += "# " + one_line(added.name) + ": left out, no number\n";
  columns_.push_back(std::move(columns));
  return id;
}

/// Names that would be the same get a number.
void CsvWriter::add_column(const std::string& full_name, const std::string& unit,
                           const std::string& doc) {
  const std::string plain = plain_name(full_name);
  std::string name = plain;
  for (int i = 2; !taken_names_.insert(name).second; ++i) name = plain + "_" + std::to_string(i);
  if (!names_.empty()) names_ += ',';
  names_ += name;
  comments_ += "# " + name + ": " + one_line(full_name);
  if (!unit.empty()) comments_ += " [" + one_line(unit) + "]";
  if (!doc.empty()) comments_ += ", " + one_line(doc);
  comments_ += '\n';
  row_.emplace_back(kMissing);
}

base::Result<void> CsvWriter::write(const Sample& sample) {
  auto usable = check_usable();
  if (!usable) return usable;
  const auto value = channels_.decode(sample);
  if (!value) return base::Error{value.error()};
  if (time_ && sample.time < *time_) {
    return channels_.refusal(
        sample.channel, "is expected to have samples from " + internal::seconds_text(*time_) +
                            " s on, but one is of " + internal::seconds_text(sample.time) + " s");
  }
  std::vector<Leaf> leaves = number_leaves(*value.value());
  Columns& columns = columns_[sample.channel];
  if (!std::ranges::equal(leaves, columns.paths, {}, &Leaf::path)) {
    return channels_.refusal(sample.channel, "is expected to have samples of " +
                                                 std::to_string(columns.paths.size()) +
                                                 " numbers as when it was added, but one has " +
                                                 std::to_string(leaves.size()));
  }
  if (sample.time != time_) begin_row(sample.time);
  if (std::exchange(columns.in_row, true)) ++replaced_;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    row_[columns.first + i] = std::move(leaves[i].text);
  }
  if (text_.size() >= kBlock) return write_text();
  ++unsaved_;
  return {};
}

void CsvWriter::begin_row(base::Time time) {
  end_row();
  time_ = time;
  row_[0] = internal::seconds_text(time);
}

/// The first row comes after the names, of which there are no more then.
void CsvWriter::end_row() {
  if (!names_.empty()) text_ += std::exchange(names_, {}) + '\n' + std::exchange(comments_, {});
  if (!time_) return;
  for (std::string& cell : row_) {
    if (&cell != row_.data()) text_ += ',';
    text_ += cell;
    cell = kMissing;
  }
  text_ += '\n';
  for (Columns& columns : columns_) columns.in_row = false;
}

base::Result<void> CsvWriter::flush() {
  auto usable = check_usable();
  return usable ? write_text() : usable;
}

base::Result<void> CsvWriter::close() {
  if (closed_) return {};
  end_row();
  if (!failure_) static_cast<void>(write_text().ok());
  closed_ = true;
  auto file_closed = file_.close();
  if (failure_) return *failure_;
  return file_closed;
}

/// After a failure nothing more is written: the file ends with its last whole row.
base::Result<void> CsvWriter::write_text() {
  const std::uint64_t before = file_.size();
  auto written = file_.write(text_);
  if (!written) {
    failure_ = base::Error{written.error()};
    const std::string_view there(text_.data(), static_cast<std::size_t>(file_.size() - before));
    const std::size_t end = there.rfind('\n');
    file_.truncate(before + (end == std::string_view::npos ? 0 : end + 1));
    return written;
  }
  text_.clear();
  unsaved_ = static_cast<std::uint64_t>(std::ranges::count_if(columns_, &Columns::in_row));
  return written;
}

}  // namespace armature::record
