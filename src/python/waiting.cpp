// SPDX-License-Identifier: GPL-2.0-or-later
#include "python/waiting.hpp"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace py = pybind11;

namespace qmorph::python {
namespace {

constexpr std::chrono::milliseconds kLook{50};

/// What the two threads share.
struct Shared {
  std::mutex mutex;
  std::condition_variable changed;
  std::string stage;
  double share = 0;
  bool ends = false, is_done = false;
  std::exception_ptr error;

  Progress tell(std::string_view now, double done) {
    const std::lock_guard lock(mutex);
    stage = now;
    share = done;
    return ends ? Progress::cancel : Progress::go_on;
  }
};

/// Python's False, or NumPy's. Other values that count as false, such as None, do not end the work.
bool is_false(const py::object& answer) {
  const std::string type = py::str(py::type::handle_of(answer).attr("__name__"));
  return (type == "bool" || type == "bool_") && PyObject_IsTrue(answer.ptr()) == 0;
}

/// Ends the work and waits for it, also when Python unwinds a thread because the process ends.
class Worker {
 public:
  Worker(Shared& shared, std::function<void()> work) : shared_(shared), thread_(std::move(work)) {}
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  ~Worker() {
    {
      const std::lock_guard lock(shared_.mutex);
      shared_.ends = true;
    }
    thread_.join();
  }

 private:
  Shared& shared_;
  std::thread thread_;
};

/// What Python raises, kept until the work has ended.
class Interruption {
 public:
  /// Whether the work is to end. Holds the interpreter's lock.
  bool look(const py::object& progress, const std::string& stage, double share, double& told) {
    if (raised_) return true;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (progress.is_none() || share <= told) return false;
      told = share;
      return is_false(progress(stage, share));
    } catch (py::error_already_set& error) {
      raised_.emplace(std::move(error));
      return true;
    }
  }
  void rethrow() {
    if (raised_) throw std::move(*raised_);
  }

 private:
  std::optional<py::error_already_set> raised_;
};

}  // namespace

void work_while_waiting(const Options& options, const py::object& progress,
                        const std::function<void(const Options&)>& work) {
  Shared shared;
  Options own = options;
  own.progress = [&](std::string_view stage, double share) { return shared.tell(stage, share); };
  std::optional<Worker> worker(std::in_place, shared, [&] {
    std::exception_ptr error;
    try {
      work(own);
    } catch (...) {
      error = std::current_exception();
    }
    const std::lock_guard lock(shared.mutex);
    shared.error = error;
    shared.is_done = true;
    shared.changed.notify_all();
  });

  Interruption interruption;
  double told = -1;
  for (bool is_done = false; !is_done;) {
    std::string stage;
    double share = 0;
    // Not by an object whose destructor takes the lock: once the interpreter has ended, taking it ends the thread, and
    // that must not happen inside a destructor.
    PyThreadState* const python = PyEval_SaveThread();
    {
      std::unique_lock lock(shared.mutex);
      is_done = shared.changed.wait_for(lock, kLook, [&] { return shared.is_done; });
      stage = shared.stage, share = is_done && !shared.error ? 1 : shared.share;
    }
    PyEval_RestoreThread(python);
    if (!interruption.look(progress, stage, share, told)) continue;
    const std::lock_guard lock(shared.mutex);
    shared.ends = true;
  }
  worker.reset();
  interruption.rethrow();
  if (shared.error) std::rethrow_exception(shared.error);
}

}  // namespace qmorph::python
