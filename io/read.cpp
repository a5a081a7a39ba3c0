// The reading of pictures as the rest of celdepth sees it: it happens in another process (read-server.cpp), which may
// crash without harm, and comes here through a socket.
//
// SPDX-License-Identifier: LGPL-3.0-or-later
#include "celdepth-io.hpp"
#include "read-wire.hpp"

#include <cerrno>
#include <filesystem>
#include <memory>
#include <mutex>
#include <vector>

#include <dlfcn.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

struct DescribedPart
{
  CeldIoPart  face;
  std::string name, profile;
};

struct CeldIoFile
{
  std::string                path; // as it was given
  std::unique_ptr<Wire>      wire;
  std::vector<DescribedPart> parts;
  int                        width, height;
};

// ------------------------------------------------------------------ the process that reads

constexpr const char *helper_name = "celdepth-read";

// Both ends are closed in programs that are started meanwhile.
struct SocketPair
{
  int ours = -1, theirs = -1;

  SocketPair ()
  {
    int ends[2];

    if (socketpair (AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends))
      throw IoFailure ("too many files are open.");
    ours = ends[0], theirs = ends[1];
  }
  ~SocketPair ()
  {
    for (int end : { ours, theirs })
      if (end >= 0)
        close (end);
  }
  SocketPair (const SocketPair &) = delete;
  SocketPair &operator= (const SocketPair &) = delete;
};

static int
take (int &descriptor)
{
  const int taken = descriptor;

  descriptor = -1;
  return taken;
}

// The helper beside this module or program, where a build or a user puts it; else where it is installed.
static std::string
find_helper ()
{
  Dl_info here;

  if (dladdr (reinterpret_cast<const void *> (&celd_io_open), &here) && here.dli_fname)
    {
      const std::filesystem::path beside = std::filesystem::path (here.dli_fname).replace_filename (helper_name);

      if (access (beside.c_str (), X_OK) == 0)
        return beside;
    }
  return std::string (CELD_LIBEXEC_FOLDER) + "/" + helper_name;
}

// Waits until the process that was started has made its own one and left.
static void
wait_for_starter (pid_t process)
{
  while (waitpid (process, nullptr, 0) < 0 && errno == EINTR)
    continue;
}

// By posix_spawn: a host that has threads must not fork.
static void
start_helper (const SocketPair &pair)
{
  const std::string          helper = find_helper ();
  char                      *words[] = { const_cast<char *> (helper.c_str ()), nullptr };
  posix_spawn_file_actions_t files;
  posix_spawnattr_t          attributes;
  sigset_t                   none, all;
  pid_t                      process;
  int                        status;

  sigemptyset (&none);
  sigfillset (&all);
  posix_spawnattr_init (&attributes);
  posix_spawnattr_setsigmask (&attributes, &none);
  posix_spawnattr_setsigdefault (&attributes, &all);
  posix_spawnattr_setflags (&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  posix_spawn_file_actions_init (&files);
  posix_spawn_file_actions_adddup2 (&files, pair.theirs, control_descriptor);
  status = posix_spawn (&process, helper.c_str (), &files, &attributes, words, environ);
  posix_spawn_file_actions_destroy (&files);
  posix_spawnattr_destroy (&attributes);
  if (status)
    throw IoFailure ("the program " + helper + ", which reads files, cannot be started.");
  wait_for_starter (process);
}

// The server's socket; -1 before the first file.
struct Server
{
  std::mutex mutex;
  int        control = -1;

  ~Server ()
  {
    if (control >= 0)
      close (control);
  }
};

static Server server;

// A conversation with a new worker; null if the server is gone, or cannot make one.
static std::unique_ptr<Wire>
ask_for_worker (int control)
{
  SocketPair            pair;
  std::unique_ptr<Wire> wire;

  if (!send_descriptor (control, pair.theirs))
    return nullptr;
  close (take (pair.theirs));
  wire = std::make_unique<Wire> (take (pair.ours));
  try
    {
      if (wire->receive<uint32_t> () == wire_greeting)
        return wire;
    }
  catch (const WireFailure &)
    {
      return nullptr;
    }
  throw IoFailure ("the program " + std::string (helper_name) + " is of another version of celdepth.");
}

// The server leaves when nobody wants it for a while; then there is a new one.
static std::unique_ptr<Wire>
start_worker ()
{
  const std::lock_guard<std::mutex> lock (server.mutex);
  std::unique_ptr<Wire>             wire;

  if (server.control >= 0)
    wire = ask_for_worker (server.control);
  if (!wire)
    {
      SocketPair pair;

      if (server.control >= 0)
        close (take (server.control));
      start_helper (pair);
      server.control = take (pair.ours);
      close (take (pair.theirs));
      wire = ask_for_worker (server.control);
    }
  if (!wire)
    throw IoFailure ("the program " + std::string (helper_name) + ", which reads files, does not answer.");
  return wire;
}

void
celd_io_fork_reader (void)
{
  const std::lock_guard<std::mutex> lock (server.mutex);
  int                               ends[2];
  pid_t                             process;

  if (server.control >= 0 || socketpair (AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends))
    return;
  process = fork ();
  if (process == 0)
    {
      close (ends[0]);
      if (fork () == 0)
        serve_readers (ends[1], -1);
      _exit (0);
    }
  close (ends[1]);
  if (process > 0)
    wait_for_starter (process);
  server.control = ends[0];
}

// ------------------------------------------------------------------ conversations

// The reason that the worker gives.
static void
check_answer (const Wire &wire)
{
  if (wire.receive<Answer> () != Answer::good)
    throw IoFailure (wire.receive_text ());
}

// Does the work; says of a worker that is gone what the artist can know.
template <typename Work>
static bool
guarded_talk (const std::string &path, CeldIoError *error, Work work)
{
  return guarded ("read", path, error, [&] {
    try
      {
        work ();
      }
    catch (const WireFailure &)
      {
        throw IoFailure ("it is damaged (reading it crashed, or took too much time or memory).");
      }
  });
}

static void
receive_part (const Wire &wire, DescribedPart &part)
{
  part.name = wire.receive_text ();
  part.face.alpha = wire.receive<uint8_t> ();
  part.face.grey = wire.receive<uint8_t> ();
  part.face.linear = wire.receive<uint8_t> ();
  part.face.bits = wire.receive<int> ();
  part.profile = wire.receive_text (longest_profile);
}

static void
open_file (CeldIoFile &file)
{
  file.wire = start_worker ();
  file.wire->send (Request::open);
  file.wire->send_text (std::filesystem::absolute (file.path).string ());
  check_answer (*file.wire);
  file.width = file.wire->receive<int> ();
  file.height = file.wire->receive<int> ();
  if (file.width < 1 || file.height < 1 || file.width > CELD_MAX_SIDE || file.height > CELD_MAX_SIDE)
    throw WireFailure ("no size that a worker sends");
  for (uint64_t n = file.wire->receive<uint64_t> (); n > 0; n--)
    {
      file.parts.emplace_back ();
      receive_part (*file.wire, file.parts.back ());
    }
  if (file.parts.empty ())
    throw WireFailure ("no parts");
  for (DescribedPart &part : file.parts)
    part.face.name = part.name.c_str ();
}

// Into a picture of the canvas, with `floats` numbers a pixel.
static void
read_pixels (const CeldIoFile &file, size_t part, Request request, size_t floats, float *pixels)
{
  const Wire  &wire = *file.wire;
  const size_t width = size_t (file.width), height = size_t (file.height);
  CeldRect     seen;
  int          y;

  wire.send (request);
  wire.send (uint64_t (part));
  check_answer (wire);
  seen = wire.receive<CeldRect> ();
  if (seen.x < 0 || seen.y < 0 || seen.width < 0 || seen.height < 0 || seen.width > file.width - seen.x ||
      seen.height > file.height - seen.y)
    throw WireFailure ("no rectangle that a worker sends");
  // What is overwritten stays untouched: a damaged file of 20000 x 20000 pixels must not cost the memory that it asks for.
  if (seen.width < file.width || seen.height < file.height)
    std::fill (pixels, pixels + floats * width * height, 0.f);
  y = seen.y;
  for (int32_t rows; (rows = wire.receive<int32_t> ()) != 0;)
    {
      if (rows == -1)
        throw IoFailure (wire.receive_text ());
      if (rows < 0 || rows > seen.y + seen.height - y)
        throw WireFailure ("no number of rows that a worker sends");
      if (seen.width == file.width)
        wire.receive (pixels + floats * width * size_t (y), sizeof (float) * floats * width * size_t (rows));
      else
        for (int j = y; j < y + rows; j++)
          wire.receive (pixels + floats * (width * size_t (j) + size_t (seen.x)),
                        sizeof (float) * floats * size_t (seen.width));
      y += rows;
    }
  if (y < seen.y + seen.height && seen.width)
    throw WireFailure ("rows are missing");
}

// ------------------------------------------------------------------ the C face

CeldIoFile *
celd_io_open (const char *path, CeldIoError *error)
{
  CeldIoFile *file = nullptr;

  if (guarded_talk (path, error, [&] {
        file = new CeldIoFile ();
        file->path = path;
        open_file (*file);
      }))
    return file;
  delete file;
  return nullptr;
}

void
celd_io_close (CeldIoFile *file)
{
  delete file;
}

int
celd_io_width (const CeldIoFile *file)
{
  return file->width;
}

int
celd_io_height (const CeldIoFile *file)
{
  return file->height;
}

size_t
celd_io_parts (const CeldIoFile *file)
{
  return file->parts.size ();
}

const CeldIoPart *
celd_io_part (const CeldIoFile *file, size_t part)
{
  return &file->parts[part].face;
}

// The letters of ASCII only, whatever the language.
static bool
same_name (const std::string &a, const char *b)
{
  const auto lower = [] (char c) { return c >= 'A' && c <= 'Z' ? char (c - 'A' + 'a') : c; };
  size_t     i = 0;

  while (i < a.size () && b[i] && lower (a[i]) == lower (b[i]))
    i++;
  return i == a.size () && !b[i];
}

size_t
celd_io_find (const CeldIoFile *file, const char *name)
{
  for (size_t i = 0; i < file->parts.size (); i++)
    if (same_name (file->parts[i].name, name))
      return i;
  return CELD_NO_INDEX;
}

const char *
celd_io_profile (const CeldIoFile *file, size_t part, size_t *size)
{
  const std::string &profile = file->parts[part].profile;

  *size = profile.size ();
  return profile.empty () ? nullptr : profile.data ();
}

bool
celd_io_read_colours (CeldIoFile *file, size_t part, float *rgba, CeldIoError *error)
{
  return guarded_talk (file->path, error, [&] { read_pixels (*file, part, Request::colours, 4, rgba); });
}

bool
celd_io_read_values (CeldIoFile *file, size_t part, float *values, CeldIoError *error)
{
  return guarded_talk (file->path, error, [&] { read_pixels (*file, part, Request::values, 1, values); });
}
