// The reading process: decodes files for programs that must not crash.
//
// A damaged file can crash the library that decodes it, or make it ask for any amount of memory.  The server therefore
// decodes nothing itself, but forks a worker for each file, with limits on memory and time.  When a worker dies, its
// end of the socket closes, which the program at the other end reports as a damaged file.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "read-file.hpp"
#include "read-wire.hpp"

#include <algorithm>
#include <csignal>
#include <fstream>
#include <limits>

#include <OpenImageIO/imageio.h>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__
#define CELD_SANITIZED true
#elif defined __has_feature
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define CELD_SANITIZED true
#endif
#endif
#ifndef CELD_SANITIZED
#define CELD_SANITIZED false
#endif

// ------------------------------------------------------------------ limits of a worker

constexpr uint64_t megabyte = uint64_t (1) << 20;
constexpr uint64_t opening_memory = 1024 * megabyte; // chosen: enough for the largest WebP, decoded at opening
constexpr uint64_t working_memory = 256 * megabyte;  // chosen: enough for strips and threads that decode EXR
constexpr unsigned opening_seconds = 60;             // chosen
constexpr double   reading_seconds = 60;             // chosen, in addition to the time for pixels
constexpr double   pixels_per_second = 1e6;          // chosen: the slowest format measured, on one core, has 10e6
constexpr int      decoding_threads = 4;             // chosen: more need memory and gain little

// Bytes of writable memory of the process, as RLIMIT_DATA counts them; 0 if unknown.
static uint64_t
memory_used ()
{
  std::ifstream pages ("/proc/self/statm");
  uint64_t      size, resident, shared, text, library, data;

  if (!(pages >> size >> resident >> shared >> text >> library >> data))
    return 0;
  return data * uint64_t (sysconf (_SC_PAGESIZE));
}

// Limits memory to the present amount and `more` bytes; not with sanitizers, which need memory without bounds.
static void
limit_memory (uint64_t more)
{
  const uint64_t used = memory_used ();
  rlimit         limit;

  if (CELD_SANITIZED || !used || getrlimit (RLIMIT_DATA, &limit))
    return;
  limit.rlim_cur = std::min<rlim_t> (used + more, limit.rlim_max);
  setrlimit (RLIMIT_DATA, &limit);
}

// ------------------------------------------------------------------ answers

static void
send_failure (const Wire &wire, const std::string &why)
{
  wire.send (Answer::failed);
  wire.send_text (why);
}

static void
send_part (const Wire &wire, const PictureFile &file, size_t part)
{
  const CeldIoPart &info = file.parts[part].info;

  wire.send_text (file.parts[part].name);
  wire.send (info.alpha);
  wire.send (info.grey);
  wire.send (info.linear);
  wire.send (info.frame);
  wire.send (info.bits);
  wire.send_text (file.profile (part), longest_profile);
}

// The file; null after an answer that says why it cannot be read.
static std::unique_ptr<PictureFile>
answer_open (const Wire &wire)
{
  const std::string            path = wire.receive_text ();
  std::unique_ptr<PictureFile> file;
  std::string                  why;

  alarm (opening_seconds);
  if (!succeeds (why, [&] { file = open_picture (path); }))
    {
      send_failure (wire, why);
      return nullptr;
    }
  alarm (0);
  wire.send (Answer::good);
  wire.send (file->width);
  wire.send (file->height);
  wire.send (uint64_t (file->parts.size ()));
  for (size_t i = 0; i < file->parts.size (); i++)
    send_part (wire, *file, i);
  return file;
}

// Sends the rectangle, then strips, each as its number of rows and their pixels; after the last one 0, after a failure
// -1 and a text.
static void
answer_pixels (const Wire &wire, PictureFile &file, Request request)
{
  const size_t part = size_t (wire.receive<uint64_t> ());
  const size_t floats = request == Request::colours ? 4 : 1;
  CeldRect     visible;
  std::string  why;

  if (!succeeds (why, [&] { visible = file.place (part); }))
    {
      send_failure (wire, why);
      return;
    }
  limit_memory (working_memory + file.decoding_memory (part) + 16 * file.size);
  alarm (unsigned (reading_seconds + double (file.width) * double (file.height) / pixels_per_second));
  wire.send (Answer::good);
  wire.send (visible);
  const bool read = succeeds (why, [&] {
    const TakeRows take = [&] (const float *rows, int count) {
      wire.send (int32_t (count));
      wire.send (rows, sizeof (float) * floats * size_t (visible.width) * size_t (count));
    };

    request == Request::colours ? file.read_colours (part, take) : file.read_values (part, take);
  });
  alarm (0);
  wire.send (int32_t (read ? 0 : -1));
  if (!read)
    wire.send_text (why);
}

// ------------------------------------------------------------------ processes

// Serves one file until the other end closes the socket.
static void
work (const Wire &wire)
{
  std::unique_ptr<PictureFile> file;

  prctl (PR_SET_DUMPABLE, 0); // no core file after a crash, which damaged files cause
  OIIO::attribute ("threads", decoding_threads);
  OIIO::attribute ("exr_threads", decoding_threads);
  wire.send (wire_version);
  if (wire.receive<Request> () != Request::open)
    return;
  limit_memory (opening_memory);
  file = answer_open (wire);
  while (file)
    answer_pixels (wire, *file, wire.receive<Request> ());
}

static void
start_worker (int control, int socket)
{
  const pid_t process = fork ();

  if (process == 0)
    {
      close (control);
      std::signal (SIGCHLD, SIG_DFL);
      try
        {
          work (Wire (socket));
        }
      catch (...) // the other end has closed the socket
        {
        }
      _exit (0);
    }
  close (socket);
}

// Leaves the process group of the program that started this one, so that signals of its terminal do not arrive; resets
// signals, and discards output.
static void
detach_from_starter ()
{
  const int null_device = open ("/dev/null", O_RDWR);

  setsid ();
  for (int number : { SIGHUP, SIGINT, SIGTERM, SIGALRM, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV })
    std::signal (number, SIG_DFL);
  std::signal (SIGCHLD, SIG_IGN); // workers need not be waited for
  if (null_device >= 0)
    {
      dup2 (null_device, STDOUT_FILENO);
      dup2 (null_device, STDERR_FILENO);
      close (null_device);
    }
}

void
serve_readers (int control, int timeout)
{
  int socket;

  detach_from_starter ();
  while ((socket = receive_descriptor (control, timeout)) >= 0)
    start_worker (control, socket);
}
