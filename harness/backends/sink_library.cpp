// Sinks: evaluators that are not a GL, from a shared library of the user.
#include <evalcts_sink.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "kinds.h"
#include "shared_library.h"

namespace evalcts {
namespace {

static_assert(EVALCTS_SINK_POSITION == kPosition && EVALCTS_SINK_COLOR == kColor &&
              EVALCTS_SINK_NORMAL == kNormal && EVALCTS_SINK_TEXCOORD == kTextureCoordinate0 &&
              EVALCTS_SINK_TEXCOORD_OTHER == kTextureCoordinatesOther && EVALCTS_SINK_ALL == kAllAttributes);

// The sink and the receiver of its context. They are global because the commands that evalcts supplies have
// no argument for them.
const evalcts_sink* described = nullptr;
const evalcts_receiver* receiving = nullptr;

const GLubyte* get_string(GLenum name) {
  const auto text = [](const char* words, const char* otherwise) {
    return reinterpret_cast<const GLubyte*>(words ? words : otherwise);
  };
  switch (name) {
    case GL_VENDOR:
      return text(described->vendor, "");
    case GL_RENDERER:
      return text(described->name, "a sink");
    case GL_VERSION:
      return text(described->gl_version, "1.1");
    default:
      return text("", "");
  }
}
void begin(GLenum mode) { receiving->begin(receiving->user, mode); }
void end() { receiving->end(receiving->user); }

class SinkContext final : public Context {
 public:
  SinkContext(const evalcts_sink& sink, const gl::Table& table, const std::string& library)
      : sink_(sink), table_(table) {
    receiver_.user = this;
    receiver_.begin = [](void* self, unsigned mode) { static_cast<SinkContext*>(self)->open(mode); };
    receiver_.end = [](void* self) { static_cast<SinkContext*>(self)->open_ = false; };
    receiver_.vertex = [](void* self, const float* position, const float* color, const float* normal,
                          const float(*texcoord)[4], unsigned units) {
      static_cast<SinkContext*>(self)->keep(position, color, normal, texcoord, units);
    };
    receiving = &receiver_;
    if (const char* reason = sink_.reset(&receiver_))
      throw CannotStart(fmt::format("{} cannot set the initial state: {}", library, reason));
  }
  SinkContext(const SinkContext&) = delete;
  SinkContext& operator=(const SinkContext&) = delete;

  const gl::Table& table() const override { return table_; }
  bool has_sink() const override { return true; }
  Attributes emitted_attributes() const override { return sink_.attributes; }
  std::vector<ObservedPrimitive> take_emitted() override { return std::exchange(emitted_, {}); }

 private:
  void open(GLenum mode) {
    emitted_.push_back({mode, {}});
    open_ = true;
  }

  void keep(const float* position, const float* color, const float* normal, const float (*texcoord)[4],
            std::size_t units) {
    if (!open_) open(GL_POINTS);  // not a place for vertices; the judge counts them
    ObservedVertex& vertex = emitted_.back().vertices.emplace_back();
    if (position) std::copy_n(position, 4, vertex.position.begin());
    if (color) std::copy_n(color, 4, vertex.color.begin());
    if (normal) std::copy_n(normal, 3, vertex.normal.begin());
    for (std::size_t unit = 0; texcoord && unit < std::min(units, kTextureUnits); ++unit)
      std::copy_n(texcoord[unit], 4, vertex.texture_coordinate[unit].begin());
  }

  const evalcts_sink& sink_;
  const gl::Table& table_;
  evalcts_receiver receiver_{};
  std::vector<ObservedPrimitive> emitted_;
  bool open_ = false;
};

class SinkLibrary final : public Implementation {
 public:
  explicit SinkLibrary(const std::string& path) : library_(path) {
    const auto open = library_.find_as<decltype(&evalcts_sink_open)>("evalcts_sink_open");
    if (!open)
      throw CannotStart(fmt::format("{} exports no evalcts_sink_open, see evalcts_sink.h", library_.path()));
    sink_ = open();
    if (!sink_) throw CannotStart(fmt::format("evalcts_sink_open of {} returns null", library_.path()));
    if (sink_->version != EVALCTS_SINK_VERSION)
      throw CannotStart(fmt::format(
          "{} was built for version {} of evalcts_sink.h, this evalcts supports version {}: rebuild it",
          library_.path(), sink_->version, EVALCTS_SINK_VERSION));
    if (!sink_->commands || !sink_->reset)
      throw CannotStart(
          fmt::format("{}: evalcts_sink::commands and evalcts_sink::reset are required", library_.path()));
    table_ = gl::load_table({[this](const char* name) { return command(name); }});
    described = sink_;
    if (!table_.GetString) table_.GetString = get_string;
    if (!table_.Begin) table_.Begin = begin;
    if (!table_.End) table_.End = end;
    for (const unsigned* target = sink_->targets; target && *target != 0; ++target)
      declaration_.targets.insert(*target);
    declaration_.max_order = sink_->max_order;
  }

  std::string name() const override { return "sink"; }
  std::string library() const override { return library_.path(); }
  const Declaration* declaration() const override { return &declaration_; }
  std::unique_ptr<Context> create_context() override {
    return std::make_unique<SinkContext>(*sink_, table_, library_.path());
  }

 private:
  void* command(const char* name) const {
    for (const evalcts_sink_command* row = sink_->commands; row->name; ++row)
      if (std::strcmp(row->name, name) == 0) return reinterpret_cast<void*>(row->function);
    return nullptr;
  }

  SharedLibrary library_;
  const evalcts_sink* sink_ = nullptr;
  gl::Table table_;
  Declaration declaration_;
};

}  // namespace

std::unique_ptr<Implementation> open_sink(const std::string& path) {
  if (path.empty())
    throw CannotStart(
        "it needs --library with a shared library that exports evalcts_sink_open, see evalcts_sink.h");
  return std::make_unique<SinkLibrary>(path);
}

}  // namespace evalcts
