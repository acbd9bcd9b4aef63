// SPDX-License-Identifier: Apache-2.0
#include "drives/canopen/eds.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace armature::canopen {
namespace {

using ::testing::HasSubstr;

constexpr const char* kDrive = R"([FileInfo]
FileName=drive.eds ; a name

[DeviceInfo]
VendorName=Somebody
VendorNumber=0x99
ProductName=A drive
ProductNumber=17
RevisionNumber=010

[MandatoryObjects]
SupportedObjects=2
1=0x1000
2=0x1018
[OptionalObjects]
SupportedObjects=3
1=0x1400
2=0x1003
3=0x6064

[1000]
ParameterName=Device type
ObjectType=0x7
DataType=0x0007
AccessType=ro
DefaultValue=0x00020192
PDOMapping=0

[1018]
ParameterName=Identity
ObjectType=9
SubNumber=2
[1018sub0]
ParameterName=Highest subindex
DataType=5
AccessType=const
DefaultValue=1
[1018SUB1]
ParameterName=Vendor-ID
DataType=7
AccessType=RO

[1400]
ParameterName=RPDO1
ObjectType=9
SubNumber=1
[1400sub1]
ParameterName=COB-ID
DataType=7
AccessType=rw
DefaultValue=$NODEID+0x200

[1003]
ParameterName=Errors
ObjectType=0x8
DataType=0x7
AccessType=ro
CompactSubObj=3
[1003Name]
NrOfEntries=1
2=The second

; the position
[6064]
ParameterName=Position actual value
ObjectType=7
DataType=0x4
AccessType=rwr
PDOMapping=1
LowLimit=-100
HighLimit=100
)";

Eds parse(const std::string& text, NodeId node = 3) {
  base::Diagnostics diagnostics;
  const auto eds = parse_eds(text, "drive.eds", node, diagnostics);
  EXPECT_TRUE(eds) << diagnostics.to_text();
  return eds.value_or(Eds{});
}

std::string mistakes_of(const std::string& text) {
  base::Diagnostics diagnostics;
  EXPECT_FALSE(parse_eds(text, "drive.eds", 3, diagnostics));
  return diagnostics.to_text();
}

TEST(Eds, TellsWhoMadeIt) {
  const Eds eds = parse(kDrive);
  EXPECT_EQ(eds.vendor_name, "Somebody");
  EXPECT_EQ(eds.identity.vendor, 0x99u);
  EXPECT_EQ(eds.identity.product, 17u);
  EXPECT_EQ(eds.identity.revision, 8u) << "010 is octal";
  EXPECT_FALSE(eds.node);
}

TEST(Eds, DescribesVariables) {
  const Eds eds = parse(kDrive);
  ASSERT_NE(eds.find({0x6064, 0}), nullptr);
  EXPECT_EQ(*eds.find({0x6064, 0}), (EdsObject{.name = "Position actual value",
                                               .type = DataType::kInteger32,
                                               .access = Access::kReadWrite,
                                               .mappable = true,
                                               .low = -100,
                                               .high = 100}));
  EXPECT_EQ(eds.find({0x1000, 0})->value, 0x00020192);
  EXPECT_EQ(eds.find({0x1018, 1})->name, "Vendor-ID");
  EXPECT_EQ(eds.find({0x9999, 0}), nullptr);
}

TEST(Eds, TheNodesNumberIsAdded) {
  EXPECT_EQ(parse(kDrive, 3).find({0x1400, 1})->value, 0x203);
  EXPECT_EQ(parse(kDrive, 9).find({0x1400, 1})->value, 0x209);
}

TEST(Eds, ACompactArrayHasItsElements) {
  const Eds eds = parse(kDrive);
  EXPECT_EQ(eds.find({0x1003, 0})->value, 3);
  EXPECT_EQ(eds.find({0x1003, 1})->name, "Errors1");
  EXPECT_EQ(eds.find({0x1003, 2})->name, "The second");
  EXPECT_NE(eds.find({0x1003, 3}), nullptr);
  EXPECT_EQ(eds.find({0x1003, 4}), nullptr);
}

TEST(Eds, ADcfHasItsOwnNodeAndValues) {
  const Eds eds = parse(std::string(kDrive) +
                        "[DeviceComissioning]\nNodeID=5\n[6081]\nDataType=7\nDefaultValue=1\n"
                        "ParameterValue=2\n");
  EXPECT_EQ(eds.node, NodeId{5});
  EXPECT_EQ(eds.find({0x1400, 1})->value, 0x205);
  EXPECT_EQ(eds.find({0x6081, 0})->value, 2);
}

TEST(Eds, IsReadAsItIsWritten) {
  const Eds eds = parse(kDrive);
  EXPECT_EQ(parse(to_text(eds)), eds);
}

TEST(Eds, ADictionaryIsMadeOfItAndDescribedAgain) {
  ObjectDictionary dictionary;
  add_objects(parse(kDrive), dictionary);
  EXPECT_EQ(dictionary.number({0x1400, 1}), 0x203);
  EXPECT_EQ(dictionary.find({0x6064, 0})->info.high, 100);
  EXPECT_EQ(describe(dictionary, "", "").find({0x6064, 0})->type, DataType::kInteger32);
}

TEST(Eds, NegativeNumbersAreWrittenEitherWay) {
  for (const char* value : {"-1", "0xFFFFFFFF"}) {
    const Eds eds = parse(std::string("[6064]\nDataType=4\nDefaultValue=") + value + "\n");
    ObjectDictionary dictionary;
    add_objects(eds, dictionary);
    EXPECT_EQ(dictionary.number({0x6064, 0}), -1) << value;
  }
}

TEST(Eds, EveryMistakeHasItsLine) {
  const std::string mistakes = mistakes_of(
      "Key=1\n[1000\nDataType=0x99\n[1001]\nno equals\nDataType=5\nDataType=6\nDefaultValue=256\n"
      "AccessType=readable\n[1001]\n[1400]\nObjectType=9\nSubNumber=4\n[1005]\n"
      "DefaultValue=$NODE+1\n[MandatoryObjects]\nSupportedObjects=1\n1=0x1234\n");
  for (const char* expected :
       {"drive.eds:1: error: 'Key=1' is in no section (begin one with [Name])",
        "drive.eds:2: error: section [1000 has no end (end it with ])",
        "drive.eds:5: error: expected [Section] or Key=value, found 'no equals'",
        "drive.eds:7: error: 'datatype' is there twice in [1001] (remove one)",
        "drive.eds:10: error: section [1001] is there twice (merge both)",
        "drive.eds:11: error: [1400] SubNumber is 4, and there are 0 sections such as [1400sub1]",
        "drive.eds:15: error: [1005] defaultvalue: expected a number such as 12, 0x1A or "
        "$NODEID+0x180, found '$node+1'",
        "drive.eds:18: error: [mandatoryobjects] lists 0x1234, which has no section"}) {
    EXPECT_THAT(mistakes, HasSubstr(expected));
  }
}

TEST(Eds, ValuesTypesAndAccessAreChecked) {
  EXPECT_THAT(mistakes_of("[1001]\nDataType=5\nDefaultValue=256\n"),
              HasSubstr("drive.eds:3: error: [1001] defaultvalue is 256, which is no UNSIGNED8"));
  EXPECT_THAT(mistakes_of("[1001]\nDataType=0x1f\n"),
              HasSubstr("drive.eds:2: error: [1001] DataType is 31, which CiA 301 does not have"));
  EXPECT_THAT(mistakes_of("[1001]\nAccessType=readable\n"),
              HasSubstr("drive.eds:2: error: [1001] AccessType is 'readable', expected ro, wo"));
  EXPECT_THAT(mistakes_of("[1003]\nDataType=7\nCompactSubObj=300\n"),
              HasSubstr("CompactSubObj is 300, expected 1 to 254"));
  EXPECT_THAT(mistakes_of("[DeviceComissioning]\nNodeID=200\n"),
              HasSubstr("NodeID is 200, expected 1 to 127"));
}

TEST(Eds, AnEmptyFileDescribesNothing) {
  EXPECT_THAT(mistakes_of("; nothing\n"), HasSubstr("describes no objects"));
}

}  // namespace
}  // namespace armature::canopen
