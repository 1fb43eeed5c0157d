// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace datmo {

/// From now on SIGINT and SIGTERM (Ctrl-C, kill) do not end the program but are recorded, so that
/// it can exit by itself and remove incomplete output. Clears signals recorded before.
void noteInterruptions();

/// True once a signal has been recorded.
bool interrupted();

}  // namespace datmo
