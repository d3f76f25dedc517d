// The processes, started by mpirun, that share one sweep. Only the program evalcts-lab-mpi supports them; it
// is built if MPI is installed, and is otherwise the same as evalcts-lab.
#pragma once

#include <atomic>
#include <functional>
#include <memory>

#include <evalcts/accuracy/checkpoint.h>

namespace evalcts::cli {

class World {
 public:
  virtual ~World() = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;

  // Runs the sweep like accuracy::sweep(), and also hands out blocks to the other ranks. Called once, by rank
  // 0. Throws CannotStart if another rank cannot start, or its implementation is not that of `identity`.
  virtual void lead(const accuracy::SweepIdentity& identity, const accuracy::StreamSource& source,
                    int threads, accuracy::SweepState& state, const std::atomic<bool>& stop,
                    const std::function<void(const accuracy::SweepState&)>& progress) = 0;
  // Tells the other ranks to end. Called by rank 0 instead of lead() if there is nothing to do.
  virtual void dismiss() = 0;
  // Computes blocks until there are no more. Called by the other ranks. Errors are sent to rank 0, which
  // reports them.
  virtual void serve(const accuracy::SweepTask& task, const std::function<accuracy::StreamSource()>& source,
                     int threads) = 0;
};

// Joins the processes of mpirun, which are left when the object is destroyed. Throws CannotStart. Null in
// evalcts-lab; evalcts-lab-mpi sets it.
extern std::unique_ptr<World> (*join_world)();

// Returns the number of processes that mpirun or srun started, according to environment variables;
// at least 1.
int processes_of_environment();

}  // namespace evalcts::cli
