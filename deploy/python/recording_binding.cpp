// longreach.read: the topics of a recording as columns.

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cmath>
#include <deque>
#include <map>
#include <memory>
#include <set>

#include "common/recording/mcap_reader.hpp"
#include "common/recording/quiet_protobuf.hpp"
#include "common/recording/topic_decoder.hpp"
#include "deploy/python/bindings.hpp"

namespace longreach {
namespace {

namespace py = pybind11;

using google::protobuf::FieldDescriptor;

/// The values of a column so far, in the narrowest type that holds them.
class ColumnValues {
 public:
  explicit ColumnValues(const RecordedColumn& column) : column_(column), kind_(kind_of(*column.back())) {}

  void add(const google::protobuf::Message& message) {
    const RecordedValue value = value_in(message, column_);
    missing_ = missing_ || value.message == nullptr;
    switch (kind_) {
      case Kind::kReal:
        reals_.push_back(value.message == nullptr ? std::nan("") : real(value));
        break;
      case Kind::kWhole:
        present_.push_back(value.message != nullptr);
        wholes_.push_back(value.message == nullptr ? 0 : whole(value));
        break;
      case Kind::kText:
        texts_.push_back(value.message == nullptr ? "" : text(value));
        break;
    }
  }

  /// float64 with NaN where there is no value; int64 if every message has one; else a list of texts.
  [[nodiscard]] py::object values() const {
    if (kind_ == Kind::kText) return py::cast(texts_);
    if (kind_ == Kind::kReal)
      return py::array_t<double>(static_cast<py::ssize_t>(reals_.size()), reals_.data());
    if (!missing_) return py::array_t<std::int64_t>(static_cast<py::ssize_t>(wholes_.size()), wholes_.data());
    py::array_t<double> result(static_cast<py::ssize_t>(wholes_.size()));
    double* to = result.mutable_data();
    for (std::size_t i = 0; i < wholes_.size(); ++i)
      *to++ = present_[i] ? static_cast<double>(wholes_[i]) : std::nan("");
    return result;
  }

 private:
  enum class Kind { kReal, kWhole, kText };
  static Kind kind_of(const FieldDescriptor& field) {
    if (field.is_repeated()) return Kind::kText;
    switch (field.cpp_type()) {
      case FieldDescriptor::CPPTYPE_DOUBLE:
      case FieldDescriptor::CPPTYPE_FLOAT:
        return Kind::kReal;
      case FieldDescriptor::CPPTYPE_INT32:
      case FieldDescriptor::CPPTYPE_INT64:
      case FieldDescriptor::CPPTYPE_UINT32:
      case FieldDescriptor::CPPTYPE_UINT64:
      case FieldDescriptor::CPPTYPE_BOOL:
        return Kind::kWhole;
      default:
        return Kind::kText;
    }
  }
  static double real(const RecordedValue& v) {
    const auto& r = *v.message->GetReflection();
    return v.field->cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE
               ? r.GetDouble(*v.message, v.field)
               : static_cast<double>(r.GetFloat(*v.message, v.field));
  }
  /// Values of 2^63 and more wrap.
  static std::int64_t whole(const RecordedValue& v) {
    const auto& r = *v.message->GetReflection();
    switch (v.field->cpp_type()) {
      case FieldDescriptor::CPPTYPE_INT32:
        return r.GetInt32(*v.message, v.field);
      case FieldDescriptor::CPPTYPE_INT64:
        return r.GetInt64(*v.message, v.field);
      case FieldDescriptor::CPPTYPE_UINT32:
        return r.GetUInt32(*v.message, v.field);
      case FieldDescriptor::CPPTYPE_UINT64:
        return static_cast<std::int64_t>(r.GetUInt64(*v.message, v.field));
      default:
        return r.GetBool(*v.message, v.field) ? 1 : 0;
    }
  }
  static std::string text(const RecordedValue& v) {
    if (!v.field->is_repeated()) return text_of(v);
    std::string all;
    const int size = v.message->GetReflection()->FieldSize(*v.message, v.field);
    for (int i = 0; i < size; ++i) all += (i > 0 ? " " : "") + text_of(v, i);
    return all;
  }

  RecordedColumn column_;
  Kind kind_;
  std::vector<double> reals_{};
  std::vector<std::int64_t> wholes_{};
  std::vector<bool> present_{};
  std::vector<std::string> texts_{};
  bool missing_ = false;
};

struct Topic {
  explicit Topic(const McapSchema& schema) : decoder(schema) {
    for (const RecordedColumn& column : decoder.columns()) columns.emplace_back(column);
  }
  void add(const McapMessage& message, std::uint64_t first_ns) {
    if (!decoder.decode(message.bytes)) {
      ++bad;
      return;
    }
    t_s.push_back(1e-9 * static_cast<double>(static_cast<std::int64_t>(message.log_time_ns - first_ns)));
    log_time_ns.push_back(static_cast<std::int64_t>(message.log_time_ns));
    for (ColumnValues& column : columns) column.add(decoder.message());
  }
  [[nodiscard]] py::dict table() const {
    const auto rows = static_cast<py::ssize_t>(t_s.size());
    py::dict all;
    all["t_s"] = py::array_t<double>(rows, t_s.data());
    all["log_time_ns"] = py::array_t<std::int64_t>(rows, log_time_ns.data());
    for (std::size_t i = 0; i < columns.size(); ++i)
      all[py::str(name_of(decoder.columns()[i]))] = columns[i].values();
    return all;
  }

  TopicDecoder decoder;
  std::vector<double> t_s;
  std::vector<std::int64_t> log_time_ns;
  std::deque<ColumnValues> columns;
  std::uint64_t bad = 0;
};

struct Tables {
  std::map<std::string, std::unique_ptr<Topic>> topics;
  std::set<std::string> skipped;
};

void add(Tables& tables, const McapReader& reader, const McapMessage& message, std::uint64_t first_ns) {
  const McapChannel& channel = *message.channel;
  const auto schema = reader.schemas().find(channel.schema);
  const bool known = schema != reader.schemas().end();
  const std::string reason = reason_not_decodable(channel, known ? &schema->second : nullptr);
  if (!reason.empty()) {
    tables.skipped.insert(channel.topic + " (" + reason + ")");
    return;
  }
  auto& topic = tables.topics[channel.topic];
  try {
    if (!topic) topic = std::make_unique<Topic>(schema->second);
    topic->add(message, first_ns);
  } catch (const SchemaError& error) {
    tables.skipped.insert(channel.topic + " (" + error.what() + ")");
  }
}

/// Reads the messages in slices, so that the caller can be interrupted between them.
class RecordingReader {
 public:
  explicit RecordingReader(const std::string& file) : reader_(file), first_ns_(mcap_figures(file).first_ns) {}

  /// Returns false at the end of the file.
  bool read(std::int64_t messages) {
    const QuietProtobuf quiet;
    for (std::int64_t i = 0; i < messages; ++i) {
      const auto message = reader_.next();
      if (!message) return false;
      add(tables_, reader_, *message, first_ns_);
    }
    return true;
  }
  [[nodiscard]] py::dict topics() const {
    py::dict all;
    for (const auto& [name, topic] : tables_.topics) {
      if (topic && !topic->t_s.empty()) all[py::str(name)] = topic->table();
    }
    return all;
  }
  [[nodiscard]] std::vector<std::string> skipped() const {
    std::vector<std::string> all(tables_.skipped.begin(), tables_.skipped.end());
    for (const auto& [name, topic] : tables_.topics) {
      if (topic && topic->bad > 0)
        all.push_back(std::to_string(topic->bad) + " messages of " + name + " do not match its schema");
    }
    if (!reader_.lost().empty()) all.push_back(lost_sentence(reader_.lost(), first_ns_));
    return all;
  }
  [[nodiscard]] std::map<std::string, TextMap> metadata() const { return reader_.metadata(); }
  [[nodiscard]] bool whole() const { return reader_.whole(); }

 private:
  McapReader reader_;
  Tables tables_{};
  std::uint64_t first_ns_;
};

}  // namespace

void bind_recording(py::module_& module) {
  py::class_<RecordingReader>(module, "RecordingReader")
      .def(py::init<const std::string&>(), py::arg("file"))
      .def("read", &RecordingReader::read, py::call_guard<py::gil_scoped_release>(), py::arg("messages"))
      .def("topics", &RecordingReader::topics)
      .def("skipped", &RecordingReader::skipped)
      .def("metadata", &RecordingReader::metadata)
      .def("whole", &RecordingReader::whole);
}

}  // namespace longreach
