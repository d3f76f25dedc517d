// The executable specification: the evaluator state machine of the GL, written to be read beside the
// specification. An object is a context in RGBA mode, and a copy is a second context in the same state.
//
// The methods are the GL commands without their prefix. All argument values are valid for a call, except that
// pointers must point to the storage that the command may access; if the GL does not define the effect of a
// null pointer (U-NULL), the command does nothing. Commands that the GL does not allow between Begin and End
// raise INVALID_OPERATION there (GL 2.1 section 2.6.3). A command that raises an error has no other effect
// (GL 2.1 section 2.5). While a display list is under construction, commands are compiled into it and not
// executed, or (COMPILE_AND_EXECUTE) executed as well. Commands that the GL never compiles are executed at
// once (section 5.4).
#pragma once

#include <GL/gl.h>
#include <GL/glext.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include <reference/component.h>

namespace evalcts::reference {

// One value of the answer to a query, as far as the documents permit it.
struct PermittedValue {
  double state = 0;  // the value before its conversion to the type of the query
  // Permitted results of the conversion, the likeliest first. Beyond these, floats and doubles may be rounded
  // to single precision in other ways (EV-GETMAP-FLOAT, EV-GETMAP-DOUBLE).
  std::vector<double> answers;
  bool is_exact = false;  // a float of the state other than colours and normals, which Get returns unchanged
  bool is_least = false;  // a limit of the implementation: any greater value is permitted as well
  // Only the reference pages give the value (an initial domain), or documents disagree so far that it must
  // not be judged (integers for colours and normals outside [-1,1], C-GETMAPIV-NORM).
  bool is_advisory = false;
  int since = 10;  // the first version (10 * major + minor) whose text gives the value
};

class Specification {
 public:
  struct Options {
    int max_eval_order = kMaxOrder;     // 8..kMaxOrder (EV-INIT-MAXORDER); other values are clamped
    int texture_units = kTextureUnits;  // units with coordinates, 1..kTextureUnits; other values are clamped
    // Units that ActiveTexture accepts. From GL 2.0 on, these may be more, because units for images count as
    // well (GL 2.1 2.7). At least texture_units, at most kTextureUnits; other values are clamped.
    int active_units = 0;
    bool keeps_vertices = true;  // false: primitives have no vertices, for callers that need only answers
  };

  // Makes a context in the initial state of the GL (EV-INIT-*).
  Specification();
  explicit Specification(const Options& options);

  // Maps (section 5.1). Both forms copy the points during the call (EV-MAP1-COPY), and read none if an
  // argument is invalid. GetnMap writes nothing and raises INVALID_OPERATION if the answer has more than
  // `size` bytes (GL 4.5 section 21.1.1).
  void Map1f(GLenum target, GLfloat u1, GLfloat u2, GLint stride, GLint order, const GLfloat* points);
  void Map1d(GLenum target, GLdouble u1, GLdouble u2, GLint stride, GLint order, const GLdouble* points);
  void Map2f(GLenum target, GLfloat u1, GLfloat u2, GLint ustride, GLint uorder, GLfloat v1, GLfloat v2,
             GLint vstride, GLint vorder, const GLfloat* points);
  void Map2d(GLenum target, GLdouble u1, GLdouble u2, GLint ustride, GLint uorder, GLdouble v1, GLdouble v2,
             GLint vstride, GLint vorder, const GLdouble* points);
  void GetMapfv(GLenum target, GLenum query, GLfloat* v);
  void GetMapdv(GLenum target, GLenum query, GLdouble* v);
  void GetMapiv(GLenum target, GLenum query, GLint* v);
  void GetnMapfv(GLenum target, GLenum query, GLsizei size, GLfloat* v);
  void GetnMapdv(GLenum target, GLenum query, GLsizei size, GLdouble* v);
  void GetnMapiv(GLenum target, GLenum query, GLsizei size, GLint* v);

  // Enables: the 18 maps and AUTO_NORMAL.
  void Enable(GLenum cap);
  void Disable(GLenum cap);
  GLboolean IsEnabled(GLenum cap);

  // Queries of single values (section 6.1): the enables, MAX_EVAL_ORDER, the grids, the current values,
  // ACTIVE_TEXTURE, EDGE_FLAG, RGBA_MODE, INDEX_MODE, MAX_TEXTURE_UNITS, MAX_TEXTURE_COORDS, LIST_BASE,
  // LIST_INDEX, LIST_MODE, MAX_LIST_NESTING, ATTRIB_STACK_DEPTH, MAX_ATTRIB_STACK_DEPTH. Other names are
  // INVALID_ENUM.
  void GetBooleanv(GLenum pname, GLboolean* params);
  void GetIntegerv(GLenum pname, GLint* params);
  void GetFloatv(GLenum pname, GLfloat* params);
  void GetDoublev(GLenum pname, GLdouble* params);
  const GLubyte* GetString(GLenum name);
  GLenum GetError();

  // No commands are ever pending (section 5.5).
  void Flush();
  void Finish();

  // Display lists (section 5.4). CallList and CallLists take the time of all commands in the lists.
  void NewList(GLuint list, GLenum mode);
  void EndList();
  void CallList(GLuint list);
  void CallLists(GLsizei n, GLenum type, const void* lists);
  void ListBase(GLuint base);
  GLuint GenLists(GLsizei range);  // OUT_OF_MEMORY above 65536
  GLboolean IsList(GLuint list);
  void DeleteLists(GLuint list, GLsizei range);

  // The attribute stack (section 6.1.14). A bit whose group has no state here saves nothing.
  void PushAttrib(GLbitfield mask);
  void PopAttrib();

  // Evaluation (section 5.1). Like Vertex, these commands have no effect outside Begin/End
  // (U-OUTSIDE-VERTEX).
  void EvalCoord1f(GLfloat u);
  void EvalCoord1d(GLdouble u);
  void EvalCoord1fv(const GLfloat* u);
  void EvalCoord1dv(const GLdouble* u);
  void EvalCoord2f(GLfloat u, GLfloat v);
  void EvalCoord2d(GLdouble u, GLdouble v);
  void EvalCoord2fv(const GLfloat* u);
  void EvalCoord2dv(const GLdouble* u);

  // Grids and evaluation at grid points (section 5.1). Arguments are the real numbers i*du + u1, exact at
  // both ends. Time and memory of a mesh are proportional to its index range.
  void MapGrid1f(GLint un, GLfloat u1, GLfloat u2);
  void MapGrid1d(GLint un, GLdouble u1, GLdouble u2);
  void MapGrid2f(GLint un, GLfloat u1, GLfloat u2, GLint vn, GLfloat v1, GLfloat v2);
  void MapGrid2d(GLint un, GLdouble u1, GLdouble u2, GLint vn, GLdouble v1, GLdouble v2);
  void EvalPoint1(GLint i);
  void EvalPoint2(GLint i, GLint j);
  void EvalMesh1(GLenum mode, GLint i1, GLint i2);
  void EvalMesh2(GLenum mode, GLint i1, GLint i2, GLint j1, GLint j2);

  // Begin/End, vertices and current values (sections 2.6, 2.7).
  void Begin(GLenum mode);
  void End();

  void Vertex2f(GLfloat x, GLfloat y);
  void Vertex3f(GLfloat x, GLfloat y, GLfloat z);
  void Vertex4f(GLfloat x, GLfloat y, GLfloat z, GLfloat w);
  void Vertex2d(GLdouble x, GLdouble y);
  void Vertex3d(GLdouble x, GLdouble y, GLdouble z);
  void Vertex4d(GLdouble x, GLdouble y, GLdouble z, GLdouble w);
  void Vertex2fv(const GLfloat* v);
  void Vertex3fv(const GLfloat* v);
  void Vertex4fv(const GLfloat* v);
  void Vertex2dv(const GLdouble* v);
  void Vertex3dv(const GLdouble* v);
  void Vertex4dv(const GLdouble* v);

  void Color3f(GLfloat red, GLfloat green, GLfloat blue);
  void Color4f(GLfloat red, GLfloat green, GLfloat blue, GLfloat alpha);
  void Color3d(GLdouble red, GLdouble green, GLdouble blue);
  void Color4d(GLdouble red, GLdouble green, GLdouble blue, GLdouble alpha);
  void Color3fv(const GLfloat* v);
  void Color4fv(const GLfloat* v);
  void Color3dv(const GLdouble* v);
  void Color4dv(const GLdouble* v);

  void Normal3f(GLfloat x, GLfloat y, GLfloat z);
  void Normal3d(GLdouble x, GLdouble y, GLdouble z);
  void Normal3fv(const GLfloat* v);
  void Normal3dv(const GLdouble* v);

  void TexCoord1f(GLfloat s);
  void TexCoord2f(GLfloat s, GLfloat t);
  void TexCoord3f(GLfloat s, GLfloat t, GLfloat r);
  void TexCoord4f(GLfloat s, GLfloat t, GLfloat r, GLfloat q);
  void TexCoord1d(GLdouble s);
  void TexCoord2d(GLdouble s, GLdouble t);
  void TexCoord3d(GLdouble s, GLdouble t, GLdouble r);
  void TexCoord4d(GLdouble s, GLdouble t, GLdouble r, GLdouble q);
  void TexCoord1fv(const GLfloat* v);
  void TexCoord2fv(const GLfloat* v);
  void TexCoord3fv(const GLfloat* v);
  void TexCoord4fv(const GLfloat* v);
  void TexCoord1dv(const GLdouble* v);
  void TexCoord2dv(const GLdouble* v);
  void TexCoord3dv(const GLdouble* v);
  void TexCoord4dv(const GLdouble* v);

  void MultiTexCoord1f(GLenum texture, GLfloat s);
  void MultiTexCoord2f(GLenum texture, GLfloat s, GLfloat t);
  void MultiTexCoord3f(GLenum texture, GLfloat s, GLfloat t, GLfloat r);
  void MultiTexCoord4f(GLenum texture, GLfloat s, GLfloat t, GLfloat r, GLfloat q);
  void MultiTexCoord1d(GLenum texture, GLdouble s);
  void MultiTexCoord2d(GLenum texture, GLdouble s, GLdouble t);
  void MultiTexCoord3d(GLenum texture, GLdouble s, GLdouble t, GLdouble r);
  void MultiTexCoord4d(GLenum texture, GLdouble s, GLdouble t, GLdouble r, GLdouble q);
  void MultiTexCoord1fv(GLenum texture, const GLfloat* v);
  void MultiTexCoord2fv(GLenum texture, const GLfloat* v);
  void MultiTexCoord3fv(GLenum texture, const GLfloat* v);
  void MultiTexCoord4fv(GLenum texture, const GLfloat* v);
  void MultiTexCoord1dv(GLenum texture, const GLdouble* v);
  void MultiTexCoord2dv(GLenum texture, const GLdouble* v);
  void MultiTexCoord3dv(GLenum texture, const GLdouble* v);
  void MultiTexCoord4dv(GLenum texture, const GLdouble* v);

  void Indexf(GLfloat c);
  void Indexd(GLdouble c);
  void Indexfv(const GLfloat* c);
  void Indexdv(const GLdouble* c);
  void EdgeFlag(GLboolean flag);
  void EdgeFlagv(const GLboolean* flag);
  void ActiveTexture(GLenum texture);

  // The functions below are not GL commands.

  // Returns the primitives completed since the last call, one for each Begin/End pair, including empty
  // primitives and those of meshes. A primitive that is still open is returned after its End.
  std::vector<Primitive> take_primitives();

  // Returns true between Begin and End, when a primitive is open.
  bool inside() const { return open_.has_value(); }

  // Returns every error code that the last command may raise (EV-MAP-ERR-ANY, U-WHICH-ERROR), the raised one
  // first; empty if it raised none. CallList and CallLists return the codes of all commands in the lists,
  // because an implementation may record several until they are queried. GetError returns the first error
  // since the last GetError.
  const std::vector<GLenum>& permitted_errors() const { return permitted_errors_; }
  // Returns how often the last command raised an error: more than once only if it called lists.
  std::size_t raised_errors() const { return raised_errors_; }

  // Returns what the documents permit as the answer to the last command, if it was a query by Get, GetMap or
  // GetnMap that was not rejected; otherwise nothing.
  const std::vector<PermittedValue>& permitted_answer() const { return permitted_answer_; }

  // Returns true if Get answers the queries of this name, or Enable accepts it. Other names may belong to
  // parts of the GL that have no state here.
  bool has_state(GLenum name) const { return answer(name).has_value(); }

 private:
  struct CurrentValues {
    std::array<GLfloat, 4> color{1, 1, 1, 1};
    std::array<GLfloat, 3> normal{0, 0, 1};
    std::array<std::array<GLfloat, 4>, kTextureUnits> texture_coordinate;
    GLfloat index = 1;
    bool edge_flag = true;
    CurrentValues() { texture_coordinate.fill({0, 0, 0, 1}); }
  };
  struct GridDirection {
    GLint segments = 1;
    GLdouble first = 0, last = 1;
    Argument at(std::int64_t i) const;
  };
  struct Enables {
    std::array<bool, 2 * kMapKinds> maps{};  // MAP1 targets, then MAP2 targets
    bool auto_normal = false;
  };
  struct Grids {
    GridDirection map1_u, map2_u, map2_v;
  };
  // The state that the attribute stack can save. Map contents are not part of it (EV-ATTRIB-NOMAPS).
  struct Attributes {
    Enables enables;
    Grids grids;
    CurrentValues current;
    int active_texture = 0;
    GLuint list_base = 0;
  };
  struct SavedAttributes {
    GLbitfield mask;
    Attributes values;
  };
  // A call of a method with its arguments and copies of the memory that they point to.
  using Command = std::function<void(Specification&)>;
  using DisplayList = std::vector<Command>;
  // The display list between NewList and EndList.
  struct Construction {
    GLuint name;
    GLenum mode;
    DisplayList list;
  };
  // A condition under which a command is rejected, and the error that it raises.
  struct Objection {
    bool applies;
    GLenum error;
  };
  using Objections = std::vector<Objection>;
  // The arguments of Map1 and Map2 for one direction.
  template <typename T>
  struct MapDirection {
    T first, last;
    GLint stride, order;
  };

  static constexpr int kMaxListNesting = 64;
  static constexpr std::size_t kMaxAttribStackDepth = 16;

  // The answer to a query, before conversion to the queried type (GL 2.1 section 6.1.2).
  struct Answer {
    enum class Kind {
      kBoolean,
      kInteger,
      kFloatingPoint,
      kNormalized
    } kind;  // kNormalized: colours and normals
    std::vector<double> values;
    bool is_limit = false;  // the least value that an implementation may have
  };

  // Returns the index of a map target in maps_.
  static std::size_t slot(GLenum target);

  // Called first by every command that a list can contain: appends the command to the list under
  // construction, if there is one. Returns true if the command must not be executed (COMPILE). Commands that
  // a called list executes are not appended, because the list contains the call.
  template <typename... Parameters>
  bool compiled(void (Specification::*command)(Parameters...),
                std::type_identity_t<Parameters>... arguments) {
    if (!construction_ || list_depth_ > 0) return false;
    permitted_errors_.clear();
    raised_errors_ = 0;
    construction_->list.push_back([=](Specification& gl) { (gl.*command)(arguments...); });
    return construction_->mode == GL_COMPILE;
  }
  // Raises the error of the first objection that applies. Returns false if none applies. Called at the start
  // of the execution of every command.
  bool reject_if(const Objections& objections);

  // Map1 and Map2. Map1 has order 1 in v. `is_target`: the command accepts the target.
  template <typename T>
  void map(bool is_target, GLenum target, const MapDirection<T>& u, const MapDirection<T>& v,
           const T* points);
  // Completes map(): `objections` are those to its arguments, `map` is the new map if none applies.
  void define(Objections objections, std::shared_ptr<const Map> map);
  template <typename T>
  void get_map(GLenum target, GLenum query, GLsizei size, T* v);
  template <typename T>
  void get(GLenum pname, T* params);
  std::optional<Answer> answer(GLenum pname) const;
  // Writes the first permitted answers, and keeps all of them for permitted_answer().
  template <typename T>
  void write(std::vector<PermittedValue> values, T* params);
  static bool is_unit(GLenum texture, int units);
  // Returns the state of an enable, or nothing if `cap` does not name one.
  std::optional<bool> enabled(GLenum cap) const;
  void set_enabled(GLenum cap, bool enabled);

  // Completes CallLists with the offsets that it has read.
  void call_lists(Objections objections, std::vector<GLuint> offsets);
  // Executes lists in order. Names without a list are skipped.
  void execute(const std::vector<GLuint>& names);

  // Returns the map that generates one kind of data in one dimension (1 or 2): the first enabled map of
  // `targets`, which are MAP1 targets in order of precedence (EV-PREC-*). Returns null if none is enabled.
  std::shared_ptr<const Map> effective_map(int dimension, std::initializer_list<GLenum> targets) const;
  // Evaluates as EvalCoord1 (without v) or EvalCoord2 does.
  void eval_coord(const Argument& u, const std::optional<Argument>& v);
  void eval_point(std::int64_t i);
  void eval_point(std::int64_t i, std::int64_t j);
  // Sets new grids of one or two directions, for MapGrid1 and MapGrid2.
  void map_grid(std::initializer_list<std::pair<GridDirection*, GridDirection>> directions);
  // Draws Begin(mode), the vertices, and End. `mesh`: see Primitive.
  template <typename Vertices>
  void draw(GLenum mode, std::size_t mesh, Vertices vertices);

  void vertex(double x, double y, double z, double w);
  void color(double red, double green, double blue, double alpha);
  void normal(double x, double y, double z);
  void texture_coordinate(GLenum texture, double s, double t, double r, double q);
  void index(double c);
  // Returns a vertex at the origin with all current values.
  Vertex current_vertex() const;

  int max_eval_order_;
  int texture_units_, active_units_;
  bool keeps_vertices_;
  std::array<std::shared_ptr<const Map>, 2 * kMapKinds> maps_;  // MAP1 targets, then MAP2 targets
  Attributes attributes_;
  std::vector<SavedAttributes> attribute_stack_;
  std::map<GLuint, DisplayList> lists_;
  std::optional<Construction> construction_;
  int list_depth_ = 0;             // number of nested lists that are being executed
  std::optional<Primitive> open_;  // the primitive between Begin and End
  std::vector<Primitive> completed_;
  std::size_t meshes_ = 0;  // number of EvalMesh2 commands so far
  GLenum error_ = GL_NO_ERROR;
  std::vector<GLenum> permitted_errors_;
  std::size_t raised_errors_ = 0;
  std::vector<PermittedValue> permitted_answer_;
};

}  // namespace evalcts::reference
