// Processes that share one sweep, as mpirun starts them. The program evalcts knows of none; evalcts-mpi,
// which is built where MPI is, is the same program with these.
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

  // Rank 0, once: as accuracy::sweep(), while the other ranks take blocks as they ask for them. A rank that
  // cannot start, or whose implementation is another one than `identity` says, ends it with CannotStart.
  virtual void lead(const accuracy::SweepIdentity& identity, const accuracy::StreamSource& source,
                    int threads, accuracy::SweepState& state, const std::atomic<bool>& stop,
                    const std::function<void(const accuracy::SweepState&)>& progress) = 0;
  // Rank 0, instead of lead(): there is nothing to do.
  virtual void dismiss() = 0;
  // The other ranks: does blocks until there is no more. What goes wrong here is for rank 0 to say.
  virtual void serve(const accuracy::SweepTask& task, const std::function<accuracy::StreamSource()>& source,
                     int threads) = 0;
};

// Null in evalcts; evalcts-mpi sets it. The world is left when it is destroyed. Throws CannotStart.
extern std::unique_ptr<World> (*join_world)();

// Returns the number of processes of mpirun or srun, by the environment.
int processes_of_environment();

}  // namespace evalcts::cli
