#include <process/child.h>

#include <mc/core/error.h>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

extern char** environ;

namespace carlo {

namespace {

struct NotStarted {
  int error;
};

struct Pipe {
  int read = -1, write = -1;
  Pipe() {
    int ends[2];
    mc::require(pipe2(ends, O_CLOEXEC) == 0, "no pipe: {}",
                std::strerror(errno)); // close-on-exec, so that no other child inherits the pipe
    read = ends[0];
    write = ends[1];
  }
};

// Owns the two attribute objects of posix_spawn.
struct Setup {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  Setup() {
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
  }
  ~Setup() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
  }
  Setup(const Setup&) = delete;
  Setup& operator=(const Setup&) = delete;
};

pid_t spawn(const LaunchOptions& launch, int input, int output) {
  Setup setup;
  if (!launch.folder.empty()) posix_spawn_file_actions_addchdir_np(&setup.files, launch.folder.c_str());
  posix_spawn_file_actions_adddup2(&setup.files, input, STDIN_FILENO);
  if (output >= 0) {
    posix_spawn_file_actions_adddup2(&setup.files, output, STDOUT_FILENO);
  } else {
    posix_spawn_file_actions_addopen(&setup.files, STDOUT_FILENO, launch.output_file.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0666);
    posix_spawn_file_actions_adddup2(&setup.files, STDOUT_FILENO, STDERR_FILENO);
  }
  if (launch.shared >= 0) posix_spawn_file_actions_adddup2(&setup.files, launch.shared, 3);
  sigset_t all, none;
  sigfillset(&all);
  sigemptyset(&none);
  posix_spawnattr_setsigdefault(&setup.attributes, &all);
  posix_spawnattr_setsigmask(&setup.attributes, &none);
  posix_spawnattr_setpgroup(&setup.attributes, 0);
  posix_spawnattr_setflags(&setup.attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
  std::vector<char*> arguments;
  for (const std::string& one : launch.arguments) arguments.push_back(const_cast<char*>(one.c_str()));
  arguments.push_back(nullptr);
  pid_t id = -1;
  const int error = posix_spawnp(&id, arguments[0], &setup.files, &setup.attributes, arguments.data(), environ);
  if (error != 0) throw NotStarted{error};
  return id;
}

} // namespace

ChildProcess::ChildProcess(const LaunchOptions& launch) {
  const bool piped = launch.output_file.empty();
  const Pipe in, out;
  input_ = in.write;
  output_ = piped ? out.read : -1;
  int error = 0;
  try {
    id_ = spawn(launch, in.read, piped ? out.write : -1);
  } catch (const NotStarted& e) {
    error = e.error;
  }
  close(in.read);
  close(out.write);
  if (!piped) close(out.read);
  if (error == 0) return;
  close(in.write);
  if (piped) close(out.read);
  throw mc::Error(fmt::format("cannot start '{}': {}", launch.arguments[0], std::strerror(error)));
}

ChildProcess::~ChildProcess() {
  close_input();
  if (id_ > 0) {
    kill(-id_, SIGKILL);
    wait();
  }
  if (output_ >= 0) close(output_);
}

void ChildProcess::close_input() {
  if (input_ >= 0) close(input_);
  input_ = -1;
}

bool ChildProcess::has_output() const {
  pollfd p{output_, POLLIN, 0};
  constexpr int interval = 50; // ms between two checks of the program
  while (poll(&p, 1, interval) <= 0)
    if (has_ended()) return poll(&p, 1, 0) > 0;
  return true;
}

bool ChildProcess::has_ended() const {
  siginfo_t info{};
  return waitid(P_PID, static_cast<id_t>(id_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == id_;
}

std::size_t ChildProcess::available_bytes() const {
  int bytes = 0;
  return ioctl(output_, FIONREAD, &bytes) == 0 ? static_cast<std::size_t>(bytes) : 0;
}

int ChildProcess::wait() {
  int status = 0;
  rusage used{};
  while (wait4(id_, &status, 0, &used) < 0 && errno == EINTR) {
  }
  id_ = -1;
  peak_ = 1024 * static_cast<double>(used.ru_maxrss);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::optional<int> run_program(const LaunchOptions& launch) {
  try {
    ChildProcess child(launch);
    child.close_input();
    return child.wait();
  } catch (const mc::Error&) {
    return {};
  }
}

bool write_all(int file, const void* bytes, std::size_t size) {
  const char* at = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t n = write(file, at, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

} // namespace carlo
