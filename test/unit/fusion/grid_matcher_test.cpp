// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/grid/grid_matcher.h"

#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace datmo::grid_matcher_test {
namespace {

const GridWindow kWindow{0.3, 4, 3, {-2, -1}};

Stamp at(double seconds) { return Stamp::fromSeconds(100.0 + seconds); }

SensorGrid gridAt(double seconds) { return {at(seconds), kWindow}; }

/// A lidar and a stereo camera; waits 0.1 s, accepts grids within 0.06 s, gives up on a source
/// after 0.5 s.
class GridMatcherTest : public testing::Test {
 protected:
  static SourceMatcherOptions options() {
    SourceMatcherOptions options;
    options.tolerance = 0.06;
    return options;
  }

  void lidar(double seconds) { matcher_.add("lidar", gridAt(seconds)); }
  void stereo(double seconds) { matcher_.add("stereo", gridAt(seconds)); }

  /// "lidar 0.1, stereo 0.12" or "stereo 0.3, lidar silent"; empty if nothing is ready.
  std::string next(double now) {
    const std::optional<MatchedGrids> matched = matcher_.next(at(now));
    std::string text;
    if (!matched) {
      return text;
    }
    for (const MatchedGrid& one : matched->samples) {
      const double seconds = secondsBetween(at(0.0), one.stamp);
      text += (text.empty() ? "" : ", ") + one.source + " " + toText(OptionValue(seconds));
    }
    for (const MissingSource& missing : matched->missing) {
      text += ", " + missing.source + " " + toText(missing.why);
    }
    return text;
  }

  GridMatcher matcher_{options(), {"stereo", "lidar"}};
};

TEST_F(GridMatcherTest, NoInputGivesNoOutput) { EXPECT_EQ(next(0.0), ""); }

TEST_F(GridMatcherTest, AReferenceGridIsReadyWhenTheOthersHaveReachedItsTime) {
  lidar(0.0);
  EXPECT_EQ(next(0.0), "");
  stereo(0.02);
  EXPECT_EQ(next(0.02), "lidar 0, stereo 0.02");
  EXPECT_EQ(next(0.02), "");
}

TEST_F(GridMatcherTest, TheSameStampIsEnough) {
  stereo(0.0);
  lidar(0.0);
  EXPECT_EQ(next(0.0), "lidar 0, stereo 0");
}

TEST_F(GridMatcherTest, TheNearestInTimeIsUsedAndOfTiesTheEarlier) {
  stereo(0.0);
  stereo(0.08);
  lidar(0.05);
  EXPECT_EQ(next(0.08), "lidar 0.05, stereo 0.08");
  lidar(0.12);
  stereo(0.16);
  EXPECT_EQ(next(0.16), "lidar 0.12, stereo 0.08");
}

TEST_F(GridMatcherTest, OneGridMayBeUsedTwice) {
  stereo(0.04);
  lidar(0.0);
  EXPECT_EQ(next(0.04), "lidar 0, stereo 0.04");
  lidar(0.08);
  stereo(0.2);
  EXPECT_EQ(next(0.2), "lidar 0.08, stereo 0.04");
}

TEST_F(GridMatcherTest, TheWaitIsBounded) {
  lidar(0.0);
  EXPECT_EQ(next(0.099), "");
  EXPECT_EQ(next(0.1), "lidar 0, stereo none near");
}

TEST_F(GridMatcherTest, GridsBeyondTheToleranceAreNotUsed) {
  stereo(0.0);
  lidar(0.061);
  EXPECT_EQ(next(0.161), "lidar 0.061, stereo none near");
}

TEST_F(GridMatcherTest, ASilentSourceIsNotWaitedFor) {
  stereo(0.0);
  lidar(0.4);
  EXPECT_EQ(next(0.4), "");
  EXPECT_EQ(next(0.5), "lidar 0.4, stereo silent");
  lidar(0.6);
  EXPECT_EQ(next(0.6), "lidar 0.6, stereo silent");
  stereo(0.65);
  lidar(0.7);
  EXPECT_EQ(next(0.7), "");  // it publishes again
  stereo(0.73);
  EXPECT_EQ(next(0.73), "lidar 0.7, stereo 0.73");
}

TEST_F(GridMatcherTest, ASourceWithoutGridsCountsAsSilentOnlyAfterAWhile) {
  lidar(0.0);
  EXPECT_EQ(next(0.0), "");
  EXPECT_EQ(next(0.1), "lidar 0, stereo none near");
  lidar(0.5);
  EXPECT_EQ(next(0.5), "lidar 0.5, stereo silent");
}

TEST_F(GridMatcherTest, ASilentReferenceIsReplacedUntilItReturns) {
  lidar(0.0);
  stereo(0.01);
  EXPECT_EQ(next(0.01), "lidar 0, stereo 0.01");
  stereo(0.3);
  EXPECT_EQ(next(0.3), "");
  stereo(0.49);
  EXPECT_EQ(next(0.49), "");
  stereo(0.5);
  // Its earlier grids arrived in time; the lidar's last grid is near the first of them.
  EXPECT_EQ(next(0.5), "stereo 0.01, lidar 0");
  EXPECT_EQ(next(0.5), "stereo 0.3, lidar silent");
  EXPECT_EQ(next(0.5), "stereo 0.49, lidar silent");
  EXPECT_EQ(next(0.5), "stereo 0.5, lidar silent");
  EXPECT_EQ(next(0.5), "");
  lidar(0.48);
  stereo(0.58);
  EXPECT_EQ(next(0.58), "");  // the lidar leads again, with its next grid
  lidar(0.56);
  EXPECT_EQ(next(0.58), "lidar 0.56, stereo 0.58");
}

TEST_F(GridMatcherTest, AReferenceWithoutGridsIsReplaced) {
  stereo(0.0);
  stereo(0.4);
  EXPECT_EQ(next(0.4), "");
  stereo(0.5);
  EXPECT_EQ(next(0.5), "stereo 0, lidar silent");
}

TEST_F(GridMatcherTest, StampsOfSetsIncrease) {
  std::optional<Stamp> last;
  for (int i = 0; i < 300; ++i) {
    const double now = 0.02 * i;
    if (i % 4 == 0 && (i < 100 || i > 180)) {
      lidar(now - 0.01);
    }
    if (i % 5 == 0 && (i < 150 || i > 260)) {
      stereo(now);
    }
    while (const std::optional<MatchedGrids> matched = matcher_.next(at(now))) {
      EXPECT_TRUE(!last || *last < matched->stamp());
      EXPECT_LE(secondsBetween(matched->stamp(), at(now)), 0.6);
      last = matched->stamp();
    }
  }
  ASSERT_TRUE(last);
  EXPECT_LE(secondsBetween(*last, at(0.02 * 299)), 0.2);
}

TEST_F(GridMatcherTest, GridsThatAreNotNewerAreLeftOut) {
  lidar(0.1);
  SensorGrid repeated = gridAt(0.1);
  repeated.at({0, 0}) = 80;
  matcher_.add("lidar", repeated);
  lidar(0.0);
  stereo(0.1);
  const std::optional<MatchedGrids> matched = matcher_.next(at(0.1));
  ASSERT_TRUE(matched);
  EXPECT_EQ(matched->stamp(), at(0.1));
  EXPECT_EQ(matched->reference().payload->at({0, 0}), kUnknownPercent);
  EXPECT_EQ(next(0.3), "");
}

TEST_F(GridMatcherTest, AfterAResetTimeMayStartOver) {
  lidar(50.0);
  stereo(50.0);
  EXPECT_EQ(next(50.0), "lidar 50, stereo 50");
  matcher_.reset();
  lidar(0.0);
  EXPECT_EQ(next(0.0), "");
  stereo(0.0);
  EXPECT_EQ(next(0.0), "lidar 0, stereo 0");
}

TEST_F(GridMatcherTest, AfterAResetAnotherWindowIsAccepted) {
  lidar(50.0);
  matcher_.reset();
  matcher_.add("stereo", SensorGrid(at(0.0), {0.25, 7, 5, {-3, -2}}));
  EXPECT_THROW(stereo(0.1), WrongWindowError);
}

TEST_F(GridMatcherTest, NoRateFillsTheMemory) {
  for (int i = 0; i < 10000; ++i) {
    lidar(0.001 * i);
  }
  int sets = 0;
  while (matcher_.next(at(100.0))) {
    ++sets;
  }
  EXPECT_LE(sets, 100);
}

TEST_F(GridMatcherTest, RefusesAnotherWindowAndNamesBoth) {
  lidar(0.0);
  try {
    matcher_.add("stereo", SensorGrid(at(0.0), {0.25, 7, 5, {-3, -2}}));
    FAIL() << "expected a WrongWindowError";
  } catch (const WrongWindowError& error) {
    const std::string message = error.what();
    for (const char* part : {"stereo", "7 x 5", "0.25", "4 x 3", "0.3"}) {
      EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
    }
  }
  stereo(0.0);
  EXPECT_EQ(next(0.0), "lidar 0, stereo 0");
}

TEST_F(GridMatcherTest, TheReferenceDecidesTheWindow) {
  stereo(0.0);
  const GridWindow other{0.25, 7, 5, {-3, -2}};
  matcher_.add("lidar", SensorGrid(at(0.0), other));
  EXPECT_THROW(stereo(0.01), WrongWindowError);
  EXPECT_EQ(next(0.1), "lidar 0, stereo none near");
  matcher_.add("stereo", SensorGrid(at(0.1), other));
  matcher_.add("lidar", SensorGrid(at(0.1), other));
  EXPECT_EQ(next(0.1), "lidar 0.1, stereo 0.1");
}

TEST_F(GridMatcherTest, RefusesAnUnknownSource) {
  EXPECT_THROW(matcher_.add("radar", gridAt(0.0)), std::invalid_argument);
}

TEST(GridMatcherOptionsTest, TheReferenceIsOneOfTheSources) {
  SourceMatcherOptions options;
  options.reference = "lydar";
  try {
    const GridMatcher matcher(options, {"lidar", "stereo"});
    FAIL() << "expected an OptionError";
  } catch (const OptionError& error) {
    EXPECT_STREQ(error.what(),
                 "reference = \"lydar\": expected one of the sources (lidar, stereo)");
  }
}

TEST(GridMatcherThreeSourcesTest, OfSeveralTheNextByNameReplacesTheReference) {
  GridMatcher matcher({}, {"stereo", "lidar", "mono"});
  matcher.add("lidar", gridAt(0.0));
  for (const double seconds : {0.1, 0.2, 0.3, 0.4, 0.5}) {
    matcher.add("stereo", gridAt(seconds));
    matcher.add("mono", gridAt(seconds));
  }
  const auto first = matcher.next(at(0.5));
  ASSERT_TRUE(first);
  EXPECT_EQ(first->reference().source, "lidar");
  EXPECT_EQ(first->samples.size(), 3U);
  const auto second = matcher.next(at(0.5));
  ASSERT_TRUE(second);
  EXPECT_EQ(second->reference().source, "mono");
  EXPECT_EQ(second->samples[1].source, "lidar");
  EXPECT_EQ(second->samples[2].source, "stereo");
}

TEST(GridMatcherOneSourceTest, OneSourceIsEnough) {
  GridMatcher matcher({}, {"lidar"});
  matcher.add("lidar", gridAt(0.0));
  const auto matched = matcher.next(at(0.0));
  ASSERT_TRUE(matched);
  EXPECT_EQ(matched->samples.size(), 1U);
  EXPECT_TRUE(matched->missing.empty());
}

}  // namespace
}  // namespace datmo::grid_matcher_test
