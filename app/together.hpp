#pragma once
#include <functional>
#include <string>

#include "osculate/model/analysis.hpp"

namespace osculate::app {

// Programs that mpirun, or the like, starts several times. The first of these processes speaks for
// all: what the others print goes nowhere.

/// To be called first: silences this process if it is one of the others.
void let_the_first_speak();

/// Whether this process is alone, as a command for one process wants it; says so where it is not.
[[nodiscard]] bool is_alone(const std::string& command);

/// Gives `code` back where something is wrong with the command line, which all of these processes
/// say alike; those that are silent a second later: mpirun ends the first one for the code of
/// another.
[[nodiscard]] int after_the_first(int code);

/// Does a part of the program that all these processes do: they join before it and part behind it.
/// Where one of them cannot go on it says why and ends all.
///
/// Returns    what `part` does; of several where it throws for bad input or files, the exit code of
///            that, which has been said
/// Errors     throws core::InputError where there are several, and this build knows nothing of MPI;
///            of one process what `part` throws
[[nodiscard]] int join(const std::function<int(const model::Together&)>& part);

}  // namespace osculate::app
