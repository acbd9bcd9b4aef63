// SPDX-License-Identifier: Apache-2.0
// The bytes of a small file, by hand from https://mcap.dev/spec.
#include <gtest/gtest.h>

#include "armature/platform/file.hpp"
#include "armature/record/internal/test_types.hpp"
#include "armature/record/mcap_reader.hpp"
#include "armature/record/mcap_writer.hpp"

namespace armature::record {
namespace {

/// Bytes as they are read: "01 ff".
std::string hex(const std::string& digits) {
  std::string bytes;
  for (std::size_t i = 0; i < digits.size(); i += 3) {
    bytes += static_cast<char>(std::stoi(digits.substr(i, 2), nullptr, 16));
  }
  return bytes;
}

std::string schema() {
  return hex("03 7b 00 00 00 00 00 00 00") +  // op, length
         hex("01 00") +                       // number
         hex("04 00 00 00") + "bool" +        // name
         hex("0a 00 00 00") + "jsonschema" +  // encoding
         hex("5f 00 00 00") +                 // data
         R"({"type":"object","title":"bool","properties":)"
         R"({"value":{"type":"boolean"}},"required":["value"]})";
}

std::string channel() {
  return hex("04 3d 00 00 00 00 00 00 00") +  // op, length
         hex("00 00 01 00") +                 // number, the schema's number
         hex("07 00 00 00") + "Lamp.On" +     // topic
         hex("04 00 00 00") + "json" +        // encoding
         hex("22 00 00 00") +                 // metadata
         hex("04 00 00 00") + "type" + hex("04 00 00 00") + "bool" + hex("06 00 00 00") + "layout" +
         hex("04 00 00 00") + "bool";
}

std::string chunk_at_33() {
  return hex("06 1f 01 00 00 00 00 00 00") +  // op, length
         hex("e8 03 00 00 00 00 00 00") +     // first time
         hex("e8 03 00 00 00 00 00 00") +     // last time
         hex("f7 00 00 00 00 00 00 00") +     // size
         hex("9c 18 14 22") +                 // CRC of the records
         hex("00 00 00 00") +                 // not compressed
         hex("f7 00 00 00 00 00 00 00") +     // stored size
         schema() + channel() +               //
         hex("05 24 00 00 00 00 00 00 00") +  // message: op, length
         hex("00 00 07 00 00 00") +           // channel, sequence
         hex("e8 03 00 00 00 00 00 00") +     // recorded
         hex("e8 03 00 00 00 00 00 00") +     // published
         R"({"value":true})";
}

std::string message_index_at_329() {
  return hex("07 16 00 00 00 00 00 00 00") +  // op, length
         hex("00 00 10 00 00 00") +           // channel, bytes of the array
         hex("e8 03 00 00 00 00 00 00") +     // time
         hex("ca 00 00 00 00 00 00 00");      // place in the chunk's records
}

std::string summary_at_373() {
  return schema() +                                          // at 0x175
         channel() +                                         // at 0x1f9
         hex("0b 38 00 00 00 00 00 00 00") +                 // statistics, at 0x23f: op, length
         hex("01 00 00 00 00 00 00 00") +                    // messages
         hex("01 00 01 00 00 00") +                          // schemas, channels
         hex("00 00 00 00 00 00 00 00 01 00 00 00") +        // attachments, metadata, chunks
         hex("e8 03 00 00 00 00 00 00") +                    // first time
         hex("e8 03 00 00 00 00 00 00") +                    // last time
         hex("0a 00 00 00 00 00 01 00 00 00 00 00 00 00") +  // messages by channel
         hex("08 4a 00 00 00 00 00 00 00") +                 // chunk index, at 0x280: op, length
         hex("e8 03 00 00 00 00 00 00") +                    // first time
         hex("e8 03 00 00 00 00 00 00") +                    // last time
         hex("21 00 00 00 00 00 00 00") +                    // place of the chunk
         hex("28 01 00 00 00 00 00 00") +                    // its length
         hex("0a 00 00 00 00 00 49 01 00 00 00 00 00 00") +  // message indexes by channel
         hex("1f 00 00 00 00 00 00 00") +                    // their length
         hex("00 00 00 00") +                                // not compressed
         hex("f7 00 00 00 00 00 00 00") +                    // stored size
         hex("f7 00 00 00 00 00 00 00");                     // size
}

std::string summary_offsets_at_723() {
  const std::string head = hex("0e 11 00 00 00 00 00 00 00");  // op, length
  return head + hex("03 75 01 00 00 00 00 00 00 84 00 00 00 00 00 00 00") + head +
         hex("04 f9 01 00 00 00 00 00 00 46 00 00 00 00 00 00 00") + head +
         hex("0b 3f 02 00 00 00 00 00 00 41 00 00 00 00 00 00 00") + head +
         hex("08 80 02 00 00 00 00 00 00 53 00 00 00 00 00 00 00");
}

std::string file() {
  const std::string magic = "\x89MCAP0\r\n";
  return magic + hex("01 10 00 00 00 00 00 00 00") +      // header: op, length
         hex("00 00 00 00 08 00 00 00") + "armature" +    // profile, library
         chunk_at_33() + message_index_at_329() +         //
         hex("0f 04 00 00 00 00 00 00 00 e8 4c 13 e4") +  // end of data with the CRC of all before
         summary_at_373() + summary_offsets_at_723() +    //
         hex("02 14 00 00 00 00 00 00 00") +              // footer: op, length
         hex("75 01 00 00 00 00 00 00") +                 // place of the summary
         hex("d3 02 00 00 00 00 00 00") +                 // place of the summary offsets
         hex("36 a3 7f 96") +                             // CRC from the summary to here
         magic;
}

TEST(McapGolden, TheWriterWritesTheseBytes) {
  const std::string path = testing::TempDir() + "/golden.mcap";
  auto writer = McapWriter::create(path);
  ASSERT_TRUE(writer) << writer.error();
  ASSERT_TRUE(writer.value()->add_channel(channel_of("Lamp.On", false)));
  ASSERT_TRUE(write(*writer.value(), 0, 1000, true, 7));
  ASSERT_TRUE(writer.value()->close());
  EXPECT_EQ(platform::read_file(path).value(), file());
}

TEST(McapGolden, TheReaderReadsThem) {
  const auto recording = parse_mcap(file(), "golden.mcap");
  ASSERT_TRUE(recording) << recording.error();
  const RecordedChannel channel{"Lamp.On", "bool", "bool", "", ""};
  EXPECT_EQ(recording.value().channels, std::vector{channel});
  const RecordedSample sample{0, base::time_from_ns(1000), 7, R"({"value":true})"};
  EXPECT_EQ(recording.value().samples, std::vector{sample});
}

}  // namespace
}  // namespace armature::record
