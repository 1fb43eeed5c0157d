// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_tracking/sequence_folders.h"

#include "made_rows.h"
#include "text_file.h"
#include <gtest/gtest.h>

namespace datmo::kitti::sequence_folders_test {
namespace {

class SequenceFolders : public testing::Test {
 protected:
  std::string error() const {
    return messageOf([this] { readSequences(labels_.path(), results_.path()); });
  }

  TextFolder labels_{"sequence_folders_test_labels"};
  TextFolder results_{"sequence_folders_test_results"};
};

TEST_F(SequenceFolders, AllSequencesByName) {
  labels_.write("0001.txt", "");
  labels_.write("0000.txt", "");
  labels_.write("notes.md", "no sequence");
  results_.write("0000.txt", resultLine(resultAt(0, 1, 0.0)) + "\n");
  results_.write("0001.txt", "");
  const std::vector<Sequence> sequences = readSequences(labels_.path(), results_.path());
  ASSERT_EQ(sequences.size(), 2U);
  EXPECT_EQ(sequences[0].name, "0000");
  EXPECT_EQ(sequences[0].results.size(), 1U);
  EXPECT_TRUE(sequences[1].results.empty());
}

TEST_F(SequenceFolders, ASequenceThatIsInOneFolderOnly) {
  labels_.write("0000.txt", "");
  labels_.write("0002.txt", "");
  results_.write("0000.txt", "");
  EXPECT_EQ(error(), results_.path() + "/0002.txt: no such file, expected it along with " +
                         labels_.path() + "/0002.txt");
  results_.write("0002.txt", "");
  results_.write("0003.txt", "");
  EXPECT_EQ(error(), labels_.path() + "/0003.txt: no such file, expected it along with " +
                         results_.path() + "/0003.txt");
}

TEST_F(SequenceFolders, FoldersThatAreEmptyOrNotThere) {
  EXPECT_EQ(error(), labels_.path() + ": has no NAME.txt, expected one per sequence");
  EXPECT_EQ(messageOf([this] { readSequences(labels_.path() + "/none", results_.path()); }),
            labels_.path() + "/none: not a folder, expected one with a NAME.txt per sequence");
}

}  // namespace
}  // namespace datmo::kitti::sequence_folders_test
