#include "server/messages.hpp"

#include <gtest/gtest.h>

#include <string>

namespace lekalo::server::serve_messages_test {
namespace {

TEST(Messages, AreReadWhateverTheOrderOfTheirFields) {
  const auto command = parse_client_message(
      R"({"text": "move 1 by 1 0", "mode": "free", "seq": 9007199254740991, "type": "command"})");
  ASSERT_TRUE(command);
  const auto& read = std::get<CommandMessage>(*command);
  EXPECT_EQ(read.seq, kLargestCount);
  EXPECT_EQ(read.mode, layout::Mode::free);
  EXPECT_EQ(read.text, "move 1 by 1 0");
  EXPECT_FALSE(read.preview);
  EXPECT_TRUE(std::get<CommandMessage>(
                  *parse_client_message(R"({"type":"preview","seq":1,"mode":"strict","text":""})"))
                  .preview);
  EXPECT_TRUE(std::get<UndoMessage>(*parse_client_message(R"({"type":"redo","seq":1})")).redo);
  EXPECT_EQ(std::get<SelectMessage>(*parse_client_message(R"({"type":"select","ids":[3,4]})")).ids.size(),
            2u);
}

TEST(Messages, EverythingElseIsRefusedWithASentence) {
  const std::string deep(500'000, '[');
  for (const std::string& bytes : {
           std::string(),
           std::string("{"),
           std::string("null"),
           std::string("[]"),
           std::string("{}"),
           deep,
           std::string("{\"type\":") + deep,
           std::string(R"({"type":"undo"})"),
           std::string(R"({"type":"undo","seq":1} )") + "x",
           std::string(R"({"type":"undo","seq":1}{})"),
           std::string(R"({"type":"undo","seq":1,"seq":1})"),
           std::string(R"({"type":"undo","seq":1,"mode":"free"})"),
           std::string(R"({"type":"undo","seq":1,"more":1})"),
           std::string(R"({"type":"undo","seq":-1})"),
           std::string(R"({"type":"undo","seq":1.5})"),
           std::string(R"({"type":"undo","seq":"1"})"),
           std::string(R"({"type":"undo","seq":9007199254740992})"),
           std::string(R"({"type":"undo","seq":1e999})"),
           std::string(R"({"type":"undo","seq":true})"),
           std::string(R"({"type":"undo","seq":null})"),
           std::string(R"({"type":"erase","seq":1})"),
           std::string(R"({"type":"select","ids":[[1]]})"),
           std::string(R"({"type":"select","ids":[{"a":1}]})"),
           std::string(R"({"type":"select","ids":["1"]})"),
           std::string(R"({"type":"select","ids":3})"),
           std::string(R"({"type":"command","seq":1,"mode":"loose","text":"x"})"),
           std::string(R"({"type":"command","seq":1,"mode":"free","text":"a\nb"})"),
           std::string("{\"type\":\"command\",\"seq\":1,\"mode\":\"free\",\"text\":\"\xff\"}"),
           std::string(kLargestMessage + 1, ' '),
       }) {
    const auto message = parse_client_message(bytes);
    ASSERT_FALSE(message) << bytes.substr(0, 80);
    EXPECT_EQ(message.error().code, ErrorCode::bad_input);
    EXPECT_FALSE(message.error().message.empty());
  }
}

TEST(Messages, ASelectionHasALimit) {
  std::string ids = "1";
  for (std::size_t i = 0; i < kMostSelected; ++i) ids += ",1";
  EXPECT_FALSE(parse_client_message("{\"type\":\"select\",\"ids\":[" + ids + "]}"));
  ids.resize(ids.size() - 2);
  EXPECT_TRUE(parse_client_message("{\"type\":\"select\",\"ids\":[" + ids + "]}"));
}

TEST(Names, AreShortPlainText) {
  EXPECT_TRUE(check_layout_name("Взуття, шкіра 3"));
  for (const std::string& name :
       {std::string(), std::string("a\nb"), std::string("\xc0\x80"), std::string("\xed\xa0\x80"),
        std::string("\xc2\x85"), std::string("a\xe2\x82"), std::string(201, 'a')})
    EXPECT_FALSE(check_layout_name(name)) << name;
}

TEST(Targets, AreSplitAndDecodedOnce) {
  const auto target = parse_target("/api/layouts?name=a%20b+c%2525&x");
  ASSERT_TRUE(target);
  EXPECT_EQ(target->path, "/api/layouts");
  EXPECT_EQ(*target->find("name"), "a b c%25");
  EXPECT_EQ(*target->find("x"), "");
  EXPECT_EQ(target->find("y"), nullptr);
  for (const char* bad : {"", "api", "http://a/b", "/a?b=%", "/a?b=%2", "/a?b=%zz", "/a?b=1&b=2", "/a#b"})
    EXPECT_FALSE(parse_target(bad)) << bad;
  std::string many = "/a?f";  // each is compared with all before it
  for (int i = 1; i < 64; ++i) many += "&f" + std::to_string(i);
  EXPECT_TRUE(parse_target(many));
  EXPECT_FALSE(parse_target(many + "&f64"));
  EXPECT_EQ(whole_number("0012"), 12u);
  for (const char* bad :
       {"", "-1", "+1", " 1", "1 ", "1e3", "0x1", "9007199254740992", "99999999999999999999"})
    EXPECT_FALSE(whole_number(bad)) << bad;
}

}  // namespace
}  // namespace lekalo::server::serve_messages_test
