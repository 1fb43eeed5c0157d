// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace datmo {

/// From now on SIGINT and SIGTERM (Ctrl-C, kill) do not end the program, but are noted, so that it
/// can leave by itself and take with it what is half-written. Forgets those noted before.
void noteInterruptions();

/// True once one has been noted.
bool interrupted();

}  // namespace datmo
