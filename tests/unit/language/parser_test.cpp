#include "queries/language/parser.h"

#include <gtest/gtest.h>

#include "unit/language/language_samples.h"

namespace queries {
namespace {

std::string command_error(const std::string& text) {
  const auto command = parse_command(text, full_registry());
  if (command) return "no error";
  const algebra3d::Error& error = command.error();
  return fmt::format("{}:{} {}", error.place.line, error.place.column, error.text());
}

template <typename Content>
Content content_of(const std::string& text) {
  auto command = parse_command(text, full_registry());
  EXPECT_TRUE(command.ok()) << (command ? "" : command.error().text());
  return std::get<Content>(command->content);
}

TEST(Precedence, product_before_sum_before_comparison_before_and_before_or) {
  EXPECT_EQ(parsed("1 + 2 * 3"), "(+ 1 (* 2 3))");
  EXPECT_EQ(parsed("1 * 2 + 3"), "(+ (* 1 2) 3)");
  EXPECT_EQ(parsed("a + b < c - d"), "(< (+ a b) (- c d))");
  EXPECT_EQ(parsed("a < b and c > d or e"), "(or (and (< a b) (> c d)) e)");
  EXPECT_EQ(parsed("a or b and c"), "(or a (and b c))");
}

TEST(Precedence, operators_of_one_rank_group_to_the_left) {
  EXPECT_EQ(parsed("1 - 2 - 3"), "(- (- 1 2) 3)");
  EXPECT_EQ(parsed("8 / 4 * 2 div 3 mod 5"), "(mod (div (* (/ 8 4) 2) 3) 5)");
  EXPECT_EQ(parsed("a union b + c"), "(+ (union a b) c)");
}

TEST(Precedence, predicates_stand_with_the_comparisons) {
  for (const std::string op : {"=", "#", "<", "<=", ">", ">=", "intersects", "inside", "contains", "startsWith"})
    EXPECT_EQ(parsed("a + b " + op + " c and d"), "(and (" + op + " (+ a b) c) d)");
}

TEST(Precedence, parentheses_and_postfix_bind_closest) {
  EXPECT_EQ(parsed("(1 + 2) * 3"), "(* (+ 1 2) 3)");
  EXPECT_EQ(parsed("1 + r count"), "(+ 1 (count r))");
  EXPECT_EQ(parsed("r count + 1"), "(+ (count r) 1)");
  EXPECT_EQ(parsed("not(a) and b"), "(and (not a) b)");
}

TEST(Patterns, prefix) {
  EXPECT_EQ(parsed("size(x)"), "(size x)");
  EXPECT_EQ(parsed("makePoint3D(1, 2, 3)"), "(makePoint3D 1 2 3)");
  EXPECT_EQ(parsed("size()"), "(size)");
}

TEST(Patterns, postfix_takes_its_operands_from_the_left) {
  EXPECT_EQ(parsed("r feed"), "(feed r)");
  EXPECT_EQ(parsed("a feed b feed product"), "(product (feed a) (feed b))");
  EXPECT_EQ(parsed("a feed b feed c feed product product"), "(product (feed a) (product (feed b) (feed c)))");
}

TEST(Patterns, brackets_with_values) {
  EXPECT_EQ(parsed("p rotate[c, v, 90.0]"), "(rotate p c v 90.0)");
  EXPECT_EQ(parsed("v translate[w]"), "(translate v w)");
  EXPECT_EQ(parsed("v translate[[const vector3d value (1 0 0)]]"), "(translate v (const vector3d value (1 0 0)))");
}

TEST(Patterns, brackets_with_names) {
  EXPECT_EQ(parsed("s project[A, size]"), "(project s (A size))");
  EXPECT_EQ(parsed("s sortby[A, B desc, C asc]"), "(sortby s ((A asc) (B desc) (C asc)))");
  EXPECT_EQ(parsed("s sum[A]"), "(sum s A)");
  EXPECT_EQ(parsed("a b hashjoin[A, B]"), "(hashjoin a b A B)");
  EXPECT_EQ(parsed("a b hashjoin[A, B, 97]"), "(hashjoin a b A B 97)");
}

TEST(Patterns, brackets_with_functions) {
  EXPECT_EQ(parsed("s filter[.A > 3]"), "(filter s (> (attr tuple1 A) 3))");
  EXPECT_EQ(parsed("s extend[X: .A * 2, Y: 1]"), "(extend s ((X (* (attr tuple1 A) 2)) (Y 1)))");
  EXPECT_EQ(parsed("s t symmjoin[.A = ..B]"), "(symmjoin s t (= (attr tuple1 A) (attr tuple2 B)))");
  EXPECT_EQ(parsed("s filter[fun(t: TUPLE) attr(t, A)]"), "(filter s (fun (t TUPLE) (attr t A)))");
}

TEST(Patterns, brackets_with_a_semicolon) {
  EXPECT_EQ(parsed("s groupby[A; N: group count]"), "(groupby s (A) ((N (count tuple1))))");
  EXPECT_EQ(parsed("s projectextend[; A: 1]"), "(projectextend s () ((A 1)))");
  EXPECT_EQ(parsed("s projectextend[A, B; C: .A]"), "(projectextend s (A B) ((C (attr tuple1 A))))");
}

TEST(Patterns, braces_rename_or_change_nothing) {
  EXPECT_EQ(parsed("r feed {x} count"), "(count (rename (feed r) x))");
  EXPECT_EQ(parsed("r feed {5} {0.1, 2} {memory 64} count"), "(count (feed r))");
}

TEST(Expressions, literals) {
  EXPECT_EQ(parsed("-12"), "-12");
  EXPECT_EQ(parsed("- 12"), "-12");
  EXPECT_EQ(parsed("-x"), "(- x)");
  EXPECT_EQ(parsed("- r count"), "(- (count r))");
  EXPECT_EQ(parsed("a - -b * c"), "(- a (* (- b) c))");
  EXPECT_EQ(parsed("+5"), "5.0");
  EXPECT_EQ(parsed("-9223372036854775808"), "-9223372036854775808");
  EXPECT_EQ(parsed("\"a\""), "\"a\"");
  EXPECT_EQ(parsed("'a'"), "'a'");
  EXPECT_EQ(parsed("TRUE"), "TRUE");
}

TEST(Expressions, minus_after_an_operand_subtracts) {
  EXPECT_EQ(parsed("a -3"), "(- a 3)");
  EXPECT_EQ(parsed("a - -3"), "(- a -3)");
  EXPECT_EQ(parsed("a*-3"), "(* a -3)");
}

TEST(Expressions, parameters_and_attributes) {
  EXPECT_EQ(parsed("[., .., $2, .A, ..B, $1.C, tuple, group]"),
            "(tuple1 tuple2 tuple2 (attr tuple1 A) (attr tuple2 B) (attr tuple1 C) tuple1 tuple1)");
}

TEST(Expressions, lists) {
  EXPECT_EQ(parsed("[]"), "()");
  EXPECT_EQ(parsed("[1, A desc, N: 2]"), "(1 (A desc) (N 2))");
}

TEST(Expressions, functions) {
  EXPECT_EQ(parsed("fun(a: int, b: rel(tuple([A: int]))) a"), "(fun (a int) (b (rel (tuple ((A int))))) a)");
  EXPECT_EQ(parsed("fun() 1"), "(fun 1)");
  EXPECT_EQ(parsed("fun f"), "f");
  EXPECT_EQ(parsed("f(1, g(2), h())"), "(f 1 (g 2) (h))");
}

TEST(Expressions, a_name_before_a_constant_is_an_operand) {
  EXPECT_EQ(parsed("r [const int value 1] product"), "(product r (const int value 1))");
}

TEST(Types, every_form) {
  EXPECT_EQ(parsed("[const rel(tuple([N: string, V: volume3d])) value ()]"),
            "(const (rel (tuple ((N string) (V volume3d)))) value ())");
  EXPECT_EQ(parsed("[const (rel (tuple ((N string)))) value ()]"), "(const (rel (tuple ((N string)))) value ())");
  EXPECT_EQ(parsed("[const rel([N: string]) value ()]"), "(const (rel (tuple ((N string)))) value ())");
  EXPECT_EQ(parsed("[const typeOf(1 + 2) value 3]"), "(const (typeOf (+ 1 2)) value 3)");
  EXPECT_EQ(parsed("fun(f: map(int, bool), s: stream(int)) 1"), "(fun (f (map int bool)) (s (stream int)) 1)");
}

TEST(SyntaxErrors, say_where_what_was_found_and_what_is_possible) {
  EXPECT_EQ(parsed("1 +"), "error 1:4 expected an operand, found the end of the command");
  EXPECT_EQ(parsed("1 + )"), "error 1:5 expected an operand, found ')'");
  EXPECT_EQ(parsed("(1\n + 2"), "error 2:5 expected ')' to close the bracket, found the end of the command");
  EXPECT_EQ(parsed("1 2"), "error 1:3 expected an operator between two operands");
  EXPECT_EQ(parsed("size x"), "error 1:6 expected '(' after the operator 'size', found 'x' (syntax: size(_))");
  EXPECT_EQ(parsed("s filter(.A)"),
            "error 1:9 expected '[' after 'filter', found '(' (syntax: _ filter[fun(STREAMELEM)])");
  EXPECT_EQ(parsed("s extend[A 1]"), "error 1:12 expected ':' after the name of the new attribute 'A', found '1'");
  EXPECT_EQ(parsed("s groupby[A, N: 1]"),
            "error 1:15 expected ';' in the arguments of 'groupby', found ':' (syntax: _ groupby[attributes; "
            "functions(GROUP)])");
  EXPECT_EQ(parsed("s project[1]"), "error 1:11 expected an attribute name, found '1'");
  EXPECT_EQ(parsed("r feed {+}"), "error 1:9 expected a name or a number after '{', found '+'");
  EXPECT_EQ(parsed("fun(a int) a"), "error 1:7 expected ':' after the parameter 'a', found 'int'");
  EXPECT_EQ(parsed("[1, 2"), "error 1:6 expected ']' to close the list, found the end of the command");
  EXPECT_EQ(parsed("let"), "error 1:1 expected an operand, found 'let', a word of the language");
  EXPECT_EQ(parsed("+ x"), "error 1:3 expected a number after the sign, found 'x'");
  EXPECT_EQ(parsed("+9223372036854775808 - 9223372036854775808"),
            "error 1:24 the integer 9223372036854775808 is beyond the range of ints (-9223372036854775808 to "
            "9223372036854775807); write it with a point for a real");
}

TEST(SyntaxErrors, suggest_the_operator_that_was_meant) {
  EXPECT_EQ(parsed("r feed cont"), "error 1:8 unknown operator 'cont', did you mean 'count'?");
  EXPECT_EQ(parsed("r fed[1]"), "error 1:3 unknown operator 'fed', did you mean 'feed'?");
  EXPECT_EQ(parsed("r feed xyzzy"), "error 1:8 unknown operator 'xyzzy'");
}

TEST(SyntaxErrors, operands_that_are_missing) {
  EXPECT_EQ(parsed("feed a"), "error 1:1 feed: expected 1 operand before it, found 0 (syntax: _ feed)");
  EXPECT_EQ(parsed("a product"), "error 1:3 product: expected 2 operands before it, found 1 (syntax: _ _ product)");
  EXPECT_EQ(parsed("a feed product count"),
            "error 1:8 product: expected 2 operands before it, found 1 (syntax: _ _ product)");
  EXPECT_EQ(parsed("union b"), "error 1:1 union: expected 1 operand before it, found 0 (syntax: _ union _)");
  EXPECT_EQ(parsed("a and or b"), "error 1:7 or: expected 1 operand before it, found 0 (syntax: _ or _)");
  EXPECT_EQ(parsed("1 + rotate[a, b, 1.0]"),
            "error 1:5 rotate: expected 1 operand before it, found 0 (syntax: _ rotate[_, _, _])");
}

TEST(SyntaxErrors, constants_name_the_place_inside_of_the_list) {
  EXPECT_EQ(parsed("[const point3d value (1 2"), "error 1:2 expected ']' after the value of a constant");
  EXPECT_EQ(parsed("[const point3d value\n  (1 2 12abc)]").substr(0, 10), "error 2:8 ");
  EXPECT_EQ(parsed("[const string value \"abc]"), "error 1:21 a string is not closed: expected \"");
  EXPECT_EQ(parsed("[const (rel\n (tuple (A 1x))) value ()]").substr(0, 11), "error 2:12 ");
  EXPECT_EQ(parsed("[const point3d (1 2 3)]").substr(0, 11), "error 1:17 ");
}

TEST(SyntaxErrors, characters_that_do_not_belong_to_the_language) {
  EXPECT_EQ(parsed("a \u00a7 b"), "error 1:3 the character '\u00a7' does not belong to the language");
  EXPECT_EQ(parsed("1 + \"abc"), "error 1:5 a string is not closed: expected \"");
  EXPECT_EQ(parsed("12abc"), "error 1:1 a number ends with 'a' after '12'");
}

TEST(SyntaxErrors, bytes_that_are_no_text_have_their_place_wherever_they_stand) {
  using std::string_literals::operator""s;
  const std::string utf8 = "expected UTF-8, found the byte 0x";
  EXPECT_EQ(parsed("1 +\n\"\xC3\xBC\xFF\""), "error 2:3 " + utf8 + "ff");
  EXPECT_EQ(parsed("'a\xE2\x82'"), "error 1:3 " + utf8 + "e2");
  EXPECT_EQ(parsed("<text>\x80</text--->"), "error 1:7 " + utf8 + "80");
  EXPECT_EQ(parsed("[const text value '\xC0\xAF']"), "error 1:20 " + utf8 + "c0");
  EXPECT_EQ(parsed("a\xFF"), "error 1:2 " + utf8 + "ff");
  EXPECT_EQ(parsed("\"a\0b\""s), "error 1:3 expected text, found a zero byte");
  EXPECT_EQ(parsed("1 \0 + 2"s), "error 1:3 expected text, found a zero byte");
  const auto nested = parse_command("(query \"\0\")"s, full_registry(), {"f", 7, 4});
  ASSERT_FALSE(nested.ok());
  EXPECT_EQ(nested.error().text(), "expected text, found a zero byte");
  EXPECT_EQ(nested.error().place.line, 7);
  EXPECT_EQ(nested.error().place.column, 12);
}

TEST(Expressions, a_file_atom_is_a_constant_of_type_text) {
  EXPECT_EQ(parsed("<file>it's; \"x\".q</file---> + 'b'"), "(+ (const text value <file>it's; \"x\".q</file--->) 'b')");
  EXPECT_EQ(parsed("[const text value <file>a]b</file--->]"), "(const text value <file>a]b</file--->)");
  EXPECT_EQ(parsed("1 + <file>a"), "error 1:5 a file atom is not closed: expected </file--->");
}

TEST(Commands, all_forms) {
  EXPECT_EQ(content_of<CreateDatabase>("create database d").name, "d");
  EXPECT_EQ(content_of<DeleteDatabase>("delete database d").name, "d");
  EXPECT_EQ(content_of<OpenDatabase>("open database d").name, "d");
  content_of<CloseDatabase>("close database");
  EXPECT_EQ(content_of<CreateObject>("create n : int").name, "n");
  EXPECT_FALSE(content_of<LetObject>("let n = 1").replaces);
  EXPECT_TRUE(content_of<LetObject>("let_ n = 1").replaces);
  EXPECT_EQ(content_of<UpdateObject>("update n := 1").name, "n");
  EXPECT_EQ(content_of<DeleteObject>("delete n").name, "n");
  EXPECT_EQ(to_nested(*content_of<Query>("query 1 + 2").value).print(), "(+ 1 2)");
  EXPECT_EQ(content_of<Inquiry>("list databases").subject, Inquiry::Subject::databases);
  EXPECT_EQ(content_of<Inquiry>("list objects").subject, Inquiry::Subject::objects);
  EXPECT_EQ(content_of<Inquiry>("list operators").subject, Inquiry::Subject::operators);
  EXPECT_EQ(content_of<Inquiry>("list type constructors").subject, Inquiry::Subject::type_constructors);
}

TEST(Commands, forms_that_manage_objects_and_files) {
  EXPECT_EQ(content_of<DeriveObject>("derive n = 1").name, "n");
  EXPECT_TRUE(content_of<DeleteObject>("kill n").kills);
  EXPECT_EQ(content_of<RenameObject>("changename a to b").new_name, "b");
  EXPECT_EQ(content_of<DefineType>("type t = rel(tuple([A: int]))").type.name, "rel");
  EXPECT_EQ(content_of<DeleteType>("delete type t").name, "t");
  EXPECT_EQ(content_of<SaveDatabase>("save database to 'a b.txt'").file, "a b.txt");
  EXPECT_EQ(content_of<SaveObject>("save a to f").file, "f");
  EXPECT_EQ(content_of<RestoreDatabase>("restore database d from \"f\"").file, "f");
  EXPECT_EQ(content_of<RestoreObject>("restore a from f").name, "a");
  EXPECT_EQ(content_of<TransactionStep>("abort transaction").step, TransactionStep::Step::abort);
  EXPECT_EQ(content_of<SetOption>("set \"memory\" = 64").name, "memory");
  EXPECT_EQ(to_nested(*content_of<Query>("querynt 1").value).print(), "1");
}

TEST(Commands, control_commands_hold_commands) {
  const auto conditional = content_of<Conditional>("if TRUE then query 1 else { query 2 | query 3 } endif");
  EXPECT_TRUE(std::holds_alternative<Query>(conditional.then_branch->content));
  EXPECT_EQ(std::get<Sequence>(conditional.else_branch->content).commands.size(), 2);
  const auto loop = content_of<Loop>("while x > 0 do update x := x - 1 endwhile");
  EXPECT_TRUE(std::holds_alternative<UpdateObject>(loop.body->content));
  EXPECT_TRUE(content_of<Sequence>("{{ query 1 | query 2 }}").goes_on_after_errors);
}

TEST(Commands, nested_lists_are_the_words_of_the_text) {
  EXPECT_EQ(to_nested(*content_of<Query>("(query (+ 1 2))").value).print(), "(+ 1 2)");
  EXPECT_EQ(content_of<LetObject>("(let n = (* 2 3))").name, "n");
  EXPECT_EQ(content_of<UpdateObject>("(update n := 4)").name, "n");
  EXPECT_EQ(content_of<CreateObject>("(create n : (rel (tuple ((A int)))))").type.name, "rel");
  EXPECT_EQ(content_of<OpenDatabase>("(open database d)").name, "d");
  EXPECT_EQ(content_of<Inquiry>("(list objects)").subject, Inquiry::Subject::objects);
  EXPECT_EQ(content_of<Sequence>("({ (query 1) | (query 2) })").commands.size(), 2);
  EXPECT_TRUE(content_of<Conditional>("(if TRUE then (query 1) endif)").else_branch == nullptr);
}

// What a text cannot name could neither be asked for there nor be restored once it was saved.
TEST(Commands, names_in_nested_lists_are_names) {
  const auto refused = [](const std::string& command) {
    const auto parsed_command = parse_command(command, full_registry());
    return parsed_command ? std::string("accepted") : parsed_command.error().text();
  };
  EXPECT_EQ(refused("(let abc = 1)"), "accepted");
  for (const char* name : {"%%", "1/3", "<file>a</file--->"}) {
    EXPECT_NE(refused(fmt::format("(create {} : int)", name)), "accepted");
    EXPECT_NE(refused(fmt::format("(let a = ((rel (tuple (({} int)))) ()))", name)), "accepted");
    EXPECT_NE(refused(fmt::format("(let a = (fun ({} int) 1))", name)), "accepted");
    EXPECT_NE(refused(fmt::format("(query (extend (feed r) (({} 1))))", name)), "accepted");
  }
  EXPECT_NE(refused("(query (extend (feed r) ((\"a b\" 1))))"), "accepted");
  EXPECT_EQ(refused("(query (extend (feed r) ((\"ab\" 1))))"), "accepted");
}

TEST(Commands, errors) {
  EXPECT_EQ(
      command_error("qery 1"),
      "1:1 expected a command (query, let, update, create, delete, open, list, ... see `help`), found 'qery'; did "
      "you mean 'query'?");
  EXPECT_EQ(command_error(""),
            "1:1 expected a command (query, let, update, create, delete, open, list, ... see `help`), found the end of "
            "the command");
  EXPECT_EQ(command_error("let a 1"), "1:7 expected '=' after the name 'a', found '1'");
  EXPECT_EQ(command_error("update a = 1"), "1:10 expected ':=' after the name 'a', found '='");
  EXPECT_EQ(command_error("open d"), "1:6 expected 'database' after the command, found 'd'");
  EXPECT_EQ(command_error("create a int"), "1:10 expected ':' after the name 'a', found 'int'");
  EXPECT_EQ(command_error("query 1 )"), "1:9 expected the end of the command, found ')'");
  EXPECT_EQ(command_error("let 5 = 1"), "1:5 expected the name of an object, found '5'");
}

TEST(Hints, a_missing_semicolon_is_shown_where_it_belongs) {
  EXPECT_EQ(command_error("query 1 + 2\nquery 3"),
            "1:12 expected ';' at the end of the command: 'query' in line 2 begins another one");
  EXPECT_EQ(command_error("let a = volume(S)  \n\n  let b = 2"),
            "1:18 expected ';' at the end of the command: 'let' in line 3 begins another one");
  EXPECT_EQ(command_error("query R feed count\nexplain R count"),
            "1:19 expected ';' at the end of the command: 'explain' in line 2 begins another one");
  EXPECT_EQ(command_error("query r\nquit"),
            "1:8 expected ';' at the end of the command: 'quit' in line 2 begins another one");
  EXPECT_EQ(command_error("query 1 query 2"), "1:8 expected ';' at the end of the command: 'query' begins another one");
  EXPECT_EQ(command_error("query 1 +\nlet a = 2"), "2:1 expected an operand, found 'let', a word of the language");
  EXPECT_EQ(command_error("query size(r\nlet a = 2"),
            "2:1 expected ')' in the arguments of 'size', found 'let' (syntax: size(_))");
  EXPECT_EQ(command_error("if TRUE query 1 endif"), "1:9 expected 'then' after the condition, found 'query'");
}

TEST(Hints, a_literal_that_is_not_closed_says_what_it_has_taken) {
  EXPECT_EQ(
      command_error("query 'abc;\nquery 2;\nquery 3"),
      "1:7 a text is not closed: expected '; everything from there to the end of line 3 was read as part of it, and "
      "not run");
  EXPECT_EQ(command_error("query \"abc; query 2"),
            "1:7 a string is not closed: expected \"; the rest of the line was read as part of it, and not run");
  EXPECT_EQ(command_error("query size(a) b 'c\n"),
            "1:17 a text is not closed: expected '; everything from there to the end of line 2 was read as part of it, "
            "and not run");
}

TEST(Hints, a_quote_that_opens_late_names_the_one_that_may_have_been_forgotten) {
  EXPECT_EQ(command_error("query \"abc;\nquery \"def\";\nquery 3;"),
            "2:11 a string is not closed: expected \"; everything from there to the end of line 3 was read as part of "
            "it, and not run; perhaps it is the one at 1:7 that is not closed, whose text runs over a line end");
  EXPECT_EQ(command_error("query 'abc' + 'def"), "1:15 a text is not closed: expected '");
}

TEST(Hints, operators_of_other_languages) {
  EXPECT_EQ(parsed("a == b"), "error 1:3 there is no operator '=='; write '=' for equality");
  EXPECT_EQ(parsed("R feed filter[.A != 1]"), "error 1:18 there is no operator '!='; write '#' for inequality");
  EXPECT_EQ(parsed("(a && b)"), "error 1:4 there is no operator '&&'; write 'and'");
  EXPECT_EQ(parsed("a || b"), "error 1:3 there is no operator '||'; write 'or'");
  EXPECT_EQ(parsed("!a"), "error 1:1 there is no operator '!'; write 'not(...)'");
  EXPECT_EQ(parsed("a % b"), "error 1:3 there is no operator '%'; write 'mod'");
  EXPECT_EQ(parsed("a AND b"), "error 1:3 unknown operator 'AND', did you mean 'and'?");
  EXPECT_EQ(parsed("s project[.A]"), "error 1:11 expected an attribute name, found '.A'; it stands without a dot here");
}

TEST(Hints, commands_of_other_languages) {
  const std::string instead = "write query RELATION feed filter[CONDITION] project[ATTRIBUTES] consume";
  EXPECT_EQ(command_error("select Name from Parts"), "1:1 there is no command 'select'; " + instead);
  EXPECT_EQ(command_error("query select Name from Parts"), "1:7 there is no 'select' here; " + instead);
  EXPECT_EQ(command_error("DROP a"), "1:1 there is no command 'DROP'; write delete NAME, or delete database NAME");
  const std::string upper = command_error("QUERY 1");
  EXPECT_TRUE(upper.ends_with("found 'QUERY'; did you mean 'query'? Commands are written in lower case")) << upper;
}

TEST(NamesOfOperators, a_postfix_operator_may_also_be_a_call_if_it_says_so) {
  EXPECT_EQ(parsed("r rect2region"), "(rect2region r)");
  EXPECT_EQ(parsed("rect2region(r)"), "(rect2region r)");
  EXPECT_EQ(parsed("rect2region + 1"), "(+ rect2region 1)");
}

TEST(Patterns, brackets_that_may_be_left_out) {
  EXPECT_EQ(parsed("r feed rduph count"), "(count (rduph (feed r)))");
  EXPECT_EQ(parsed("r feed rduph[97] count"), "(count (rduph (feed r) 97))");
}

TEST(ReservedWords, words_of_the_language_alone) {
  for (const char* word : {"let", "tuple", "group", "value", "TRUE", "tuple1"}) EXPECT_TRUE(is_reserved(word)) << word;
  for (const char* word : {"Parts", "sizes", "Let", "int", "volume3d", "x", "size", "feed", "count", "union", "mod"})
    EXPECT_FALSE(is_reserved(word)) << word;
}

TEST(NamesOfOperators, are_names_where_an_operand_begins) {
  EXPECT_EQ(parsed("area + 1"), "(+ area 1)");
  EXPECT_EQ(parsed("1 + area"), "(+ 1 area)");
  EXPECT_EQ(parsed("(union) * mod"), "(* union mod)");
  EXPECT_EQ(parsed("union union union"), "(union union union)");
  EXPECT_EQ(parsed("feed feed count"), "(count (feed feed))");
  EXPECT_EQ(parsed("count count"), "(count count)");
  EXPECT_EQ(parsed("not(not)"), "(not not)");
  EXPECT_EQ(parsed("s extend[count: count, V: volume(volume)]"), "(extend s ((count count) (V (volume volume))))");
  EXPECT_EQ(parsed("s project[count, area] {union}"), "(rename (project s (count area)) union)");
  EXPECT_EQ(parsed("fun(area: real, count: int) area * count"), "(fun (area real) (count int) (* area count))");
}

TEST(NamesOfOperators, are_calls_before_a_bracket) {
  EXPECT_EQ(parsed("area(area)"), "(area area)");
  EXPECT_EQ(parsed("union(a, b)"), "(union a b)");
  EXPECT_EQ(parsed("a union (b)"), "(union a b)");
}

TEST(Intersection, stands_between_its_operands) {
  EXPECT_EQ(parsed("a intersection b"), "(intersection a b)");
  EXPECT_EQ(parsed("a intersection (b)"), "(intersection a b)");
  EXPECT_EQ(parsed("a intersection (f(b, c))"), "(intersection a (f b c))");
  EXPECT_EQ(parsed("a intersection (\"x, y\")"), "(intersection a \"x, y\")");
  EXPECT_EQ(parsed("a intersection (b rotate[p, v, 30])"), "(intersection a (rotate b p v 30))");
  EXPECT_EQ(parsed("a intersection [const volume3d value (1, 2)]").substr(0, 5), "error");
  EXPECT_EQ(parsed("a intersection b intersection c"), "(intersection (intersection a b) c)");
  EXPECT_EQ(parsed("a union b intersection c minus d"), "(minus (union a (intersection b c)) d)");
  EXPECT_EQ(parsed("a intersection b = c"), "(= (intersection a b) c)");
  EXPECT_EQ(parsed("a intersection (b) union c"), "(union (intersection a b) c)");
}

TEST(Intersection, is_a_call_at_the_beginning_of_an_operand) {
  EXPECT_EQ(parsed("intersection(a, b)"), "(intersection a b)");
  EXPECT_EQ(parsed("x + intersection(a, b)"), "(+ x (intersection a b))");
  EXPECT_EQ(parsed("intersection(a, b) intersection c"), "(intersection (intersection a b) c)");
  EXPECT_EQ(parsed("a intersection intersection(b, c)"), "(intersection a (intersection b c))");
  EXPECT_EQ(parsed("intersection(a, b) union intersection(c, d)"), "(union (intersection a b) (intersection c d))");
  EXPECT_EQ(parsed("(intersection(a intersection b, c))"), "(intersection (intersection a b) c)");
  EXPECT_EQ(parsed("intersection"), "intersection");
}

TEST(Intersection, is_a_call_with_a_comma_in_its_parentheses) {
  EXPECT_EQ(parsed("R intersection(a, b) product"), "(product R (intersection a b))");
  EXPECT_EQ(parsed("R intersection (f(a, b), c) product"), "(product R (intersection (f a b) c))");
  EXPECT_EQ(parsed("a intersection (b, c)"),
            "error 1:3 expected an operator between two operands before the call of 'intersection' (syntax: _ "
            "intersection _, intersection(_, _))");
  EXPECT_EQ(parsed("a intersection"), "error 1:15 expected an operand, found the end of the command");
  EXPECT_EQ(parsed("intersection b"),
            "error 1:1 intersection: expected 1 operand before it, found 0 (syntax: _ intersection _, "
            "intersection(_, _))");
}

TEST(Joins, take_both_separators_before_their_last_argument) {
  for (const std::string op : {"knnJoin", "distanceJoin", "spatialJoin"}) {
    const std::string expected = "(" + op + " a b A B 3)";
    EXPECT_EQ(parsed("a b " + op + "[A, B, 3]"), expected);
    EXPECT_EQ(parsed("a b " + op + "[A, B; 3]"), expected);
    EXPECT_NE(parsed("a b " + op + "[A; B, 3]"), expected);
  }
  for (const std::string op : {"knnSelfJoin", "distanceSelfJoin", "spatialSelfJoin", "pointsInside"}) {
    EXPECT_EQ(parsed("a " + op + "[A, 3]"), "(" + op + " a A 3)");
    EXPECT_EQ(parsed("a " + op + "[A; 3]"), "(" + op + " a A 3)");
  }
  for (const std::string op :
       {"hashjoin", "itHashJoin", "mergejoin", "sortmergejoin", "smouterjoin", "closestPair", "itSpatialJoin"}) {
    EXPECT_EQ(parsed("a b " + op + "[A, B]"), "(" + op + " a b A B)");
    EXPECT_EQ(parsed("a b " + op + "[A; B]"), "(" + op + " a b A B)");
  }
  EXPECT_EQ(parsed("a b hashjoin[A, B; 7]"), "(hashjoin a b A B 7)");
  EXPECT_EQ(parsed("a b hashjoin[A, B, 7]"), "(hashjoin a b A B 7)");
  // A list of attributes ends at the semicolon only.
  EXPECT_EQ(parsed("a projectextend[A, N: 1]").substr(0, 5), "error");
}

TEST(SyntaxErrors, show_the_form_of_an_operator_that_is_written_in_another) {
  EXPECT_EQ(parsed("a symmetricDifference b"),
            "error 1:23 expected '(' after the operator 'symmetricDifference', found 'b' (syntax: "
            "symmetricDifference(_, _))");
  EXPECT_EQ(parsed("a symmetricDifference (b)"),
            "error 1:3 expected an operator between two operands before the call of 'symmetricDifference' (syntax: "
            "symmetricDifference(_, _))");
  EXPECT_EQ(parsed("a symmetricDifference(b, c)"),
            "error 1:3 expected an operator between two operands before the call of 'symmetricDifference' (syntax: "
            "symmetricDifference(_, _))");
  EXPECT_EQ(parsed("S volume"),
            "error 1:9 expected '(' after the operator 'volume', found the end of the command "
            "(syntax: volume(_))");
  EXPECT_EQ(parsed("volume[S]"), "error 1:7 expected '(' after the operator 'volume', found '[' (syntax: volume(_))");
  EXPECT_EQ(parsed("R count()"), "error 1:8 count: expected no arguments behind it, found '(' (syntax: _ count)");
  EXPECT_EQ(parsed("R count[A]"), "error 1:8 count: expected no arguments behind it, found '[' (syntax: _ count)");
  EXPECT_EQ(parsed("R feed(S)"), "error 1:7 feed: expected no arguments behind it, found '(' (syntax: _ feed)");
  EXPECT_EQ(parsed("R feed (S feed) product"), "(product (feed R) (feed S))");
  EXPECT_EQ(parsed("a union[b]"), "error 1:8 expected an operand after 'union', found '[' (syntax: _ union _)");
  EXPECT_EQ(parsed("a union [const volume3d value ()]"), "(union a (const volume3d value ()))");
  EXPECT_EQ(parsed("* 3"), "error 1:1 expected an operand, found '*' (syntax: _ * _)");
  EXPECT_EQ(parsed("groupby(R; A; N: 1)"),
            "error 1:10 expected ')' to close the arguments of 'groupby', found ';' (syntax: _ groupby[attributes; "
            "functions(GROUP)])");
}

TEST(SyntaxErrors, name_the_operators_for_those_of_other_languages) {
  EXPECT_EQ(parsed("a within b"), "error 1:3 unknown operator 'within', did you mean 'inside' or 'withinDistance'?");
  EXPECT_EQ(parsed("a within[b]"), "error 1:3 unknown operator 'within', did you mean 'inside' or 'withinDistance'?");
  EXPECT_EQ(parsed("a difference b"), "error 1:3 unknown operator 'difference', did you mean 'minus'?");
  EXPECT_EQ(parsed("R where[.A]"), "error 1:3 unknown operator 'where', did you mean 'filter'?");
}

TEST(NamesOfOperators, are_further_operands_where_no_operator_fits) {
  EXPECT_EQ(parsed("a product"), "error 1:3 product: expected 2 operands before it, found 1 (syntax: _ _ product)");
  EXPECT_EQ(parsed("R product product"), "(product R product)");
  EXPECT_EQ(parsed("R area product"), "(product R area)");
  EXPECT_EQ(parsed("R feed product feed product count"), "(count (product (feed R) (feed product)))");
}

TEST(NamesOfOperators, stand_in_backquotes_where_an_operator_would_be_read) {
  EXPECT_EQ(parsed("R `feed` product"), "(product R feed)");
  EXPECT_EQ(parsed("R feed `union` feed product"), "(product (feed R) (feed union))");
  EXPECT_EQ(parsed("`area`"), "area");
  EXPECT_EQ(parsed("`area`(1, 2)"), "(area 1 2)");
  EXPECT_EQ(parsed("fun(`mod`: int) `mod` mod `mod`"), "(fun (mod int) (mod mod mod))");
  EXPECT_EQ(parsed("s project[`count`] {`x`}"), "(rename (project s (count)) x)");
  EXPECT_EQ(content_of<LetObject>("let `union` = 1").name, "union");
  EXPECT_EQ(parsed("`a b`"), "error 1:1 expected a name between backquotes: a letter, then letters, digits and _");
  EXPECT_EQ(parsed("1 + `a"), "error 1:5 expected a name between backquotes: a letter, then letters, digits and _");
  EXPECT_EQ(parsed("``"), "error 1:1 expected a name between backquotes: a letter, then letters, digits and _");
}

}  // namespace
}  // namespace queries
