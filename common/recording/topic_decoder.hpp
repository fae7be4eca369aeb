#pragma once
// Decodes the messages of one topic with the schema in the recording, so that recordings of every version can
// be read. Each field that is not itself a message is a column, for example "goal.position.x".

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor_database.h>
#include <google/protobuf/dynamic_message.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/recording/mcap_reader.hpp"
#include "common/recording/recording_error.hpp"

namespace longreach {

/// Path to a value: the fields from the message inwards.
using RecordedColumn = std::vector<const google::protobuf::FieldDescriptor*>;
std::string name_of(const RecordedColumn& column);

/// A value in a message: its field, and the innermost message that has it. `message` is null if an outer field or the
/// field itself is absent.
struct RecordedValue {
  const google::protobuf::Message* message = nullptr;
  const google::protobuf::FieldDescriptor* field = nullptr;
};
RecordedValue value_in(const google::protobuf::Message& message, const RecordedColumn& column);

/// Returns a value, or one element of a repeated value, as text: numbers with all their digits, enumerations by name.
std::string text_of(const RecordedValue& value);
std::string text_of(const RecordedValue& value, int element);

/// Thrown if the messages of a topic cannot be decoded.
struct SchemaError : RecordingError {
  using RecordingError::RecordingError;
};

/// Returns why the messages of a channel cannot be decoded; empty if they can. `schema` may be null.
std::string reason_not_decodable(const McapChannel& channel, const McapSchema* schema);

class TopicDecoder {
 public:
  /// Throws SchemaError.
  explicit TopicDecoder(const McapSchema& schema);

  [[nodiscard]] const std::vector<RecordedColumn>& columns() const { return columns_; }
  /// Returns false if the message does not match the schema.
  bool decode(std::string_view bytes);
  /// Returns the last decoded message.
  [[nodiscard]] const google::protobuf::Message& message() const { return *message_; }

 private:
  /// Keeps the first error in the descriptors, which protobuf would otherwise log.
  struct FirstError : google::protobuf::DescriptorPool::ErrorCollector {
    void AddError(const std::string&, const std::string& element, const google::protobuf::Message*,
                  ErrorLocation, const std::string& message) override {
      if (text.empty()) text = element + ": " + message;
    }
    std::string text;
  };

  FirstError error_;
  google::protobuf::SimpleDescriptorDatabase files_;
  google::protobuf::DescriptorPoolDatabase known_{*google::protobuf::DescriptorPool::generated_pool()};
  // Some schemas omit google.protobuf.Timestamp.
  google::protobuf::MergedDescriptorDatabase all_{&files_, &known_};
  google::protobuf::DescriptorPool pool_{&all_, &error_};
  google::protobuf::DynamicMessageFactory factory_{&pool_};
  std::unique_ptr<google::protobuf::Message> message_;
  std::vector<RecordedColumn> columns_;
};

}  // namespace longreach
