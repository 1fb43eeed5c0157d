// SPDX-License-Identifier: BSD-3-Clause
#include "interruption.h"

#include <csignal>

namespace datmo {

namespace {

volatile std::sig_atomic_t noted = 0;

void note(int /*signal*/) { noted = 1; }

}  // namespace

void noteInterruptions() {
  noted = 0;
  std::signal(SIGINT, note);
  std::signal(SIGTERM, note);
}

bool interrupted() { return noted != 0; }

}  // namespace datmo
