// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/grid/tile_store.h"

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

namespace datmo::tile_store_test {
namespace {

constexpr int kEmpty = -1;
constexpr double kTileSize = 32.0 * 32.0 * sizeof(int) / (1024.0 * 1024.0);  // MiB

TileFileOptions noFile() { return {"", 0.0}; }

TileFileOptions fileOf(double tiles) { return {testing::TempDir(), tiles * kTileSize}; }

/// One tile each; two fit in memory.
TileStore<int> storeWithTiles(int tiles, const TileFileOptions& file) {
  TileStore<int> store(2, kEmpty, file);
  for (int i = 0; i < tiles; ++i) {
    store.put({100 * i, 0}, i);
  }
  return store;
}

void expectTiles(const TileStore<int>& store, int first, int end) {
  for (int i = first; i < end; ++i) {
    EXPECT_EQ(store.at({100 * i, 0}), i);
    EXPECT_EQ(store.at({100 * i + 1, 0}), kEmpty);
  }
  int visited = 0;
  CellIndex last{-1000, 0};
  store.forEach([&](CellIndex cell, int content) {
    EXPECT_GE(cell.column / 32, last.column / 32) << "by columns, wherever a tile lies";
    last = cell;
    visited += content == kEmpty ? 0 : 1;
  });
  EXPECT_EQ(visited, end - first);
}

TEST(TileStoreTest, CellsComeBackOnBothSidesOfTheOrigin) {
  TileStore<int> store(100, -1, noFile());
  int content = 0;
  for (const int column : {-65, -64, -33, -32, -1, 0, 31, 32}) {
    for (const int row : {-40, -1, 0, 40}) {
      store.put({column, row}, ++content);
    }
  }
  content = 0;
  for (const int column : {-65, -64, -33, -32, -1, 0, 31, 32}) {
    for (const int row : {-40, -1, 0, 40}) {
      EXPECT_EQ(store.at({column, row}), ++content) << column << ", " << row;
    }
  }
  EXPECT_EQ(store.at({5, 5}), -1);
  EXPECT_EQ(store.at({1000, 1000}), -1);
  int visited = 0;
  store.forEach([&](CellIndex cell, int value) {
    visited += value >= 0 ? 1 : 0;
    EXPECT_EQ(store.at(cell), value);
  });
  EXPECT_EQ(visited, content);
}

TEST(TileStoreTest, OfTooManyTilesTheFirstIsForgotten) {
  TileStore<int> store(2, 0, noFile());
  store.put({0, 0}, 1);
  store.put({100, 0}, 2);
  EXPECT_EQ(store.forgotten(), 0U);
  store.put({200, 0}, 3);
  EXPECT_EQ(store.forgotten(), 1U);
  EXPECT_EQ(store.at({0, 0}), 0);
  EXPECT_EQ(store.at({100, 0}), 2);
  EXPECT_EQ(store.at({200, 0}), 3);
}

TEST(TileStoreTest, PermanentTilesAreNotForgotten) {
  TileStore<int> store(2, 0, noFile());
  store.putPermanently({0, 0}, 1);
  for (int i = 1; i <= 5; ++i) {
    store.put({100 * i, 0}, i);
  }
  store.put({1, 0}, 6);
  EXPECT_EQ(store.size(), 3U);
  EXPECT_EQ(store.forgotten(), 3U);
  EXPECT_EQ(store.at({0, 0}), 1);
  EXPECT_EQ(store.at({1, 0}), 6);
  EXPECT_EQ(store.at({500, 0}), 5);
}

TEST(TileStoreTest, TilesBeyondTheMemoryLimitAreInTheFile) {
  const TileStore<int> store = storeWithTiles(6, fileOf(100.0));
  expectTiles(store, 0, 6);
  EXPECT_EQ(store.size(), 6U);
  EXPECT_EQ(store.forgotten(), 0U);
  EXPECT_EQ(store.fileError(), "");
}

TEST(TileStoreTest, ATileComesBackFromTheFileWithAllThatItHeld) {
  TileStore<int> store = storeWithTiles(4, fileOf(100.0));
  store.put({1, 0}, 77);
  EXPECT_EQ(store.at({0, 0}), 0);
  EXPECT_EQ(store.at({1, 0}), 77);
  for (int i = 4; i < 8; ++i) {  // and is written there again, changed
    store.put({100 * i, 0}, i);
  }
  EXPECT_EQ(store.at({0, 0}), 0);
  EXPECT_EQ(store.at({1, 0}), 77);
  EXPECT_EQ(store.size(), 8U);
}

TEST(TileStoreTest, ACopySharesTheFileAndNotItsChanges) {
  TileStore<int> store = storeWithTiles(4, fileOf(100.0));
  TileStore<int> copy = store;
  copy.put({0, 0}, 50);
  for (int i = 1; i < 4; ++i) {  // the first tile is written to the file again
    copy.put({100 * i, 0}, 50 + i);
  }
  expectTiles(store, 0, 4);
  EXPECT_EQ(copy.at({0, 0}), 50);
  EXPECT_EQ(copy.at({100, 0}), 51);
}

TEST(TileStoreTest, AFullFileForgetsAndReportsWhy) {
  const TileStore<int> store = storeWithTiles(6, fileOf(1.5));
  EXPECT_EQ(store.forgotten(), 3U) << "two in memory, one in the file";
  EXPECT_EQ(store.at({0, 0}), 0);
  EXPECT_EQ(store.at({100, 0}), kEmpty);
  EXPECT_EQ(store.at({500, 0}), 5);
  EXPECT_NE(store.fileError().find("max_size"), std::string::npos) << store.fileError();
}

TEST(TileStoreTest, AMissingFolderForgetsAndReportsWhy) {
  const TileStore<int> store = storeWithTiles(4, {"/nowhere/at/all", 100.0});
  EXPECT_EQ(store.forgotten(), 2U);
  EXPECT_NE(store.fileError().find("'/nowhere/at/all'"), std::string::npos) << store.fileError();
}

/// The system refuses to let a file grow beyond a limit, as on a full disk.
TEST(TileStoreTest, AFullDiskForgetsAndReportsWhy) {
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{static_cast<rlim_t>(1.5 * 32 * 32 * sizeof(int)), before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  TileStore<int> store = storeWithTiles(6, fileOf(100.0));
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_EQ(store.forgotten(), 3U);
  EXPECT_EQ(store.at({0, 0}), 0) << "what was written before";
  EXPECT_NE(store.fileError().find("cannot grow"), std::string::npos) << store.fileError();
  store.put({600, 0}, 6);
  EXPECT_EQ(store.forgotten(), 3U) << "there is room again";
  EXPECT_EQ(store.at({400, 0}), 4);
}

TEST(TileStoreTest, TheFileHasNoName) {
  std::string folder = testing::TempDir() + "/tiles_XXXXXX";  // mkdtemp's pattern
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  const TileStore<int> store = storeWithTiles(6, {folder, 100.0});
  EXPECT_EQ(store.forgotten(), 0U);
  EXPECT_TRUE(std::filesystem::is_empty(folder)) << "it is gone with the process";
  std::filesystem::remove(folder);
}

TEST(TileStoreTest, LapsOfTheSameStreetDoNotMakeTheFileGrow) {
  TileStore<int> store(2, kEmpty, fileOf(5.0));
  for (int lap = 0; lap < 10; ++lap) {
    for (int i = 0; i < 6; ++i) {
      store.put({100 * i, 0}, i);
    }
  }
  EXPECT_EQ(store.forgotten(), 0U) << store.fileError();
  expectTiles(store, 0, 6);
}

TEST(TileStoreTest, SpaceIsReusedWhenNoCopyHasTheTile) {
  TileStore<int> store = storeWithTiles(4, fileOf(3.0));
  {
    TileStore<int> copy = store;
    copy.put({0, 0}, 10);  // its slot stays allocated, as the other one has it
    EXPECT_EQ(copy.forgotten(), 0U) << "the third tile of the file";
    copy.put({100, 0}, 11);
    EXPECT_EQ(copy.forgotten(), 1U) << "full";
  }
  store.put({400, 0}, 4);
  EXPECT_EQ(store.forgotten(), 0U);
  expectTiles(store, 0, 5);
}

/// As on a failing disk.
TEST(TileStoreTest, UnreadableTilesAreLeftOutAndReported) {
  TileStore<int> store = storeWithTiles(4, fileOf(100.0));
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    std::error_code none;
    const std::string target = std::filesystem::read_symlink(entry.path(), none).string();
    const bool is_tiles =
        target.rfind(testing::TempDir(), 0) == 0 && target.find("(deleted)") != std::string::npos;
    if (is_tiles) {
      ASSERT_EQ(ftruncate(std::stoi(entry.path().filename()), 0), 0);
    }
  }
  EXPECT_EQ(store.at({0, 0}), kEmpty);
  EXPECT_NE(store.fileError().find("cannot be read"), std::string::npos) << store.fileError();
  EXPECT_EQ(store.at({300, 0}), 3) << "in memory";
  store.put({1, 0}, 7);
  EXPECT_EQ(store.at({1, 0}), 7);
  EXPECT_EQ(store.forgotten(), 1U);
}

}  // namespace
}  // namespace datmo::tile_store_test
