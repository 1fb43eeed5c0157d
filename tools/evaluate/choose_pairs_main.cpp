// SPDX-License-Identifier: BSD-3-Clause
// The matcher for programs with their own candidates: see pair_choice.h.
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "command_line.h"
#include "evaluate/pair_choice.h"
#include <nlohmann/json.hpp>

int main(int count, char** words) {
  using nlohmann::json;
  return datmo::runProgram("choose_pairs", EXIT_FAILURE, count, words, [](const auto& given) {
    std::string file;
    datmo::CommandLine line(
        "choose_pairs",
        "For each list of a JSON file, chooses the pairs with the largest sum of gains "
        "in which no row and no column occurs twice; prints their indices.",
        "files");
    line.addFile("LISTS.json", file, "lists of [row, column, gain], gain > 0")->required();
    line.read(given);
    json chosen = json::array();
    for (const json& list : json::parse(std::ifstream(file))) {
      std::vector<datmo::evaluation::PairGain> pairs;
      for (const json& pair : list) {
        pairs.push_back({pair.at(0), pair.at(1), pair.at(2)});
      }
      chosen.push_back(datmo::evaluation::choosePairs(pairs));
    }
    std::cout << chosen << '\n';
  });
}
