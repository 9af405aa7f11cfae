#pragma once
// The exit codes of the program, one for each kind of answer a script may want to tell apart.

namespace softreel::app {

enum ExitCode {
  kDone = 0,
  kAnswerIsNo = 1,        ///< compare: they differ, or a reference is missing
  kWrongUsage = 2,        ///< command line or scene, a setting that cannot hold included
  kBadInput = 3,          ///< an input file or a needed program is missing or unusable
  kSimulationFailed = 4,  ///< the simulation failed
  kBadOutput = 5,         ///< output could not be written
  kOurBug = 6,
  kInterrupted = 130,
};

/// Runs a command and turns what it throws into a message on stderr and an exit code.
int guarded_main(int argc, char** argv);

}  // namespace softreel::app
