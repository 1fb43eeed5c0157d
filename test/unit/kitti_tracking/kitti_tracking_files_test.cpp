// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/kitti_tracking_files.h"

#include "text_file.h"
#include <gtest/gtest.h>

#include "datmo_fusion/common/angle.h"

namespace datmo::kitti::kitti_tracking_files_test {
namespace {

const std::string kLabel =
    "3 7 Person_sitting 1 2 -1.5 10.0 20.0 30.0 40.0 1.7 0.6 0.8 -4.0 1.5 13.5 0.25";
const std::string kDontCare =
    "0 -1 DontCare -1 -1 -10 219.31 188.49 245.5 218.56 -1000 -1000 -1000 -10 -1 -1 -1";
const std::string kDetection = "5,2,10.0,20.0,30.0,40.0,-0.45,1.5,1.6,3.9,-9.1,0.1,32.8,-1.0,-0.8";

class KittiTrackingFiles : public testing::Test {
 protected:
  std::string file(const std::string& text) const { return folder_.write("0000.txt", text); }

  std::string labelError(const std::string& line) const {
    return messageOf([&] { readLabels(file(kLabel + "\n\n" + line + "\n")); });
  }
  std::string detectionError(const std::string& line) const {
    return messageOf([&] { readDetections(file(line)); });
  }

  TextFolder folder_{"kitti_tracking_files_test"};
};

void expectHas(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST_F(KittiTrackingFiles, Label) {
  const std::vector<TrackedObject> labels = readLabels(file(kLabel + "\n"));
  ASSERT_EQ(labels.size(), 1U);
  EXPECT_EQ(labels[0].frame, 3);
  EXPECT_EQ(labels[0].id, 7);
  EXPECT_EQ(labels[0].type, ObjectType::kPersonSitting);
  EXPECT_EQ(labels[0].truncated, 1);
  EXPECT_EQ(labels[0].occluded, 2);
  EXPECT_EQ(labels[0].alpha, -1.5);
  EXPECT_EQ(labels[0].image_box.left, 10.0);
  EXPECT_EQ(labels[0].image_box.top, 20.0);
  EXPECT_EQ(labels[0].image_box.right, 30.0);
  EXPECT_EQ(labels[0].image_box.bottom, 40.0);
  EXPECT_EQ(labels[0].box.height, 1.7);
  EXPECT_EQ(labels[0].box.width, 0.6);
  EXPECT_EQ(labels[0].box.length, 0.8);
  EXPECT_EQ(labels[0].box.x, -4.0);
  EXPECT_EQ(labels[0].box.y, 1.5);
  EXPECT_EQ(labels[0].box.z, 13.5);
  EXPECT_EQ(labels[0].box.rotation_y, 0.25);
}

TEST_F(KittiTrackingFiles, DontCareHasNoBox) {
  const std::vector<TrackedObject> labels = readLabels(file(kDontCare));
  ASSERT_EQ(labels.size(), 1U);
  EXPECT_EQ(labels[0].id, -1);
  EXPECT_EQ(labels[0].box.length, 0.0);
}

TEST_F(KittiTrackingFiles, EmptyLinesCarriageReturnsAndManyBlanks) {
  EXPECT_EQ(readLabels(file("\n" + kLabel + " \r\n\r\n  " + kDontCare)).size(), 2U);
  EXPECT_TRUE(readLabels(file("")).empty());
}

TEST_F(KittiTrackingFiles, BadLabelsNameFileLineValueAndWhatWasExpected) {
  const std::string position = folder_.path() + "/0000.txt:3: ";
  EXPECT_EQ(labelError("0 1 Car"), position + "3 columns, expected 17");
  const std::string tail = " 0 0 0 1 1 2 2 1.5 1.6 4 0 0 9 0";
  EXPECT_EQ(labelError("1.5 1 Car" + tail),
            position + "frame '1.5', expected a whole number of 0 to 2147483647");
  expectHas(labelError("x 1 Car" + tail), position + "frame 'x', expected a finite number");
  expectHas(labelError("0 -1 Car" + tail), position + "id '-1', expected a whole number of 0 to");
  expectHas(labelError("0 1 Bus" + tail), position + "type 'Bus', expected one of Car, Van,");
}

TEST_F(KittiTrackingFiles, BadNumbersInLabels) {
  const std::string head = "0 1 Car 0 0 0 1 1 2 2 ";
  expectHas(labelError(head + "nan 1.6 4 0 0 9 0"), "height 'nan', expected a finite number");
  expectHas(labelError(head + "1.5 -1.6 4 0 0 9 0"), "width '-1.6', expected at least 0");
  expectHas(labelError(head + "1.5 1.6 4m 0 0 9 0"), "length '4m', expected a finite number");
  expectHas(labelError(head + "1.5 1.6 4 inf 0 9 0"), "x 'inf', expected a finite number");
  expectHas(labelError(head + "1.5 1.6 4 0 0 1e999 0"), "z '1e999', expected a finite number");
  expectHas(labelError("0 1 Car 0 4 0 1 1 2 2 1.5 1.6 4 0 0 9 0"),
            "occluded '4', expected a whole number of -1 to 3");
}

TEST_F(KittiTrackingFiles, FilesThatAreNotThere) {
  expectHas(messageOf([&] { readLabels(folder_.path() + "/none.txt"); }),
            "/none.txt: cannot be read");
  expectHas(messageOf([&] { readLabels(folder_.path()); }), "cannot be read");
}

TEST_F(KittiTrackingFiles, ResultsNeedAScore) {
  EXPECT_EQ(readResults(file(kLabel + " 0.5")).at(0).score, 0.5);
  expectHas(messageOf([&] { readResults(file(kLabel)); }), ":1: 17 columns, expected 18");
}

TEST_F(KittiTrackingFiles, ResultsHaveOneRowForFrameAndId) {
  EXPECT_EQ(messageOf([&] { readResults(file(kLabel + " 0.5\n" + kLabel + " 0.6\n")); }),
            folder_.path() + "/0000.txt:2: id 7 a second time in frame 3, expected one row for " +
                "each frame and id");
}

TEST_F(KittiTrackingFiles, ResultsAreOfObjects) {
  expectHas(messageOf([&] { readResults(file(kDontCare + " 1")); }),
            "type 'DontCare', expected the type of an object");
}

TEST_F(KittiTrackingFiles, ResultLineIsReadAsItWasWritten) {
  const TrackedObject written = readResults(file(kLabel + " -0.125")).at(0);
  const TrackedObject read = readResults(file(resultLine(written) + "\n")).at(0);
  EXPECT_EQ(resultLine(read), resultLine(written));
  EXPECT_EQ(read.score, -0.125);
  EXPECT_EQ(read.type, ObjectType::kPersonSitting);
  EXPECT_EQ(read.box.rotation_y, 0.25);
}

TEST_F(KittiTrackingFiles, Detections) {
  const std::vector<Detection> detections = readDetections(file(kDetection + "\n"));
  ASSERT_EQ(detections.size(), 1U);
  EXPECT_EQ(detections[0].frame, 5);
  EXPECT_EQ(detections[0].type, ObjectType::kCar);
  EXPECT_EQ(detections[0].image_box.right, 30.0);
  EXPECT_EQ(detections[0].score, -0.45);
  EXPECT_EQ(detections[0].box.height, 1.5);
  EXPECT_EQ(detections[0].box.length, 3.9);
  EXPECT_EQ(detections[0].box.z, 32.8);
  EXPECT_EQ(detections[0].box.rotation_y, -1.0);
  EXPECT_EQ(detections[0].alpha, -0.8);
}

TEST_F(KittiTrackingFiles, EveryTypeOfLabel) {
  const std::string tail = " 0 0 0 1 1 2 2 1.5 1.6 4 0 0 9 0\n";
  std::string text;
  int id = 0;
  for (const std::string type : {"Car", "Van", "Truck", "Pedestrian", "Person_sitting", "Person",
                                 "Cyclist", "Tram", "Misc"}) {
    text += "0 " + std::to_string(id++) + " " + type + tail;
  }
  const std::vector<TrackedObject> labels = readLabels(file(text + kDontCare));
  ASSERT_EQ(labels.size(), 10U);
  EXPECT_EQ(labels[5].type, ObjectType::kPerson);
  EXPECT_EQ(nameOf(labels[5].type), "Person");
  EXPECT_EQ(labels[9].type, ObjectType::kDontCare);
}

TEST_F(KittiTrackingFiles, DetectionsWithoutAlpha) {
  // 45 degrees to the right, heading right: seen from the camera it moves at 45 degrees to the line
  // of sight.
  const Detection detection = readDetections(file("0,2,1,2,3,4,0.5,1.5,1.6,4,10,1,10,0\n")).at(0);
  EXPECT_DOUBLE_EQ(detection.alpha, -0.25 * kPi);
  EXPECT_EQ(detection.box.rotation_y, 0.0);
}

TEST_F(KittiTrackingFiles, BadDetections) {
  expectHas(detectionError("5,2,10.0"), ":1: 3 columns, expected 15");
  expectHas(detectionError("5,4" + kDetection.substr(3)),
            "type '4', expected a whole number of 1 to 3");
  expectHas(detectionError("5,2,,20,30,40,1,1,1,1,1,1,1,1,1"), "left '', expected a finite number");
}

}  // namespace
}  // namespace datmo::kitti::kitti_tracking_files_test
