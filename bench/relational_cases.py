"""What the relational benchmark asks: the data, and one case per operator in both languages.

Tables, in both programs made by the same formulas: Big (N tuples), Small (N / 10), Tiny (1000), each with
Id int (0, 1, ...), K int (0..999), X real (multiples of 2^-10, so that sums are exact), G int (0..100002), Name string
of ten characters.
"""

import random
from dataclasses import dataclass

SEED_ROWS = 1000


@dataclass(frozen=True)
class Case:
    """A query in both languages whose answers are to be equal. `{run}` counts the runs, from 0."""

    operator: str
    ours: str
    sqlite: str
    plan: str = ""  # what EXPLAIN QUERY PLAN must say, so that sqlite3 really does the work
    proof: tuple = ()  # another pair, asked once and not timed, whose answers show more of the result
    prepare: tuple = ()  # a pair that comes before all runs, not timed
    clean: tuple = ()  # a pair after each run, not timed
    finish: tuple = ()  # a pair after all runs
    repeat: int = 1  # times that the query runs in one process


def seed_rows():
    """The rows (A, P, N) whose product with themselves makes every table."""
    letters = random.Random(3)
    return [(a, a / 1024, "".join(letters.choices("abcdefghijklmnopqrstuvwxyz", k=5))) for a in range(SEED_ROWS)]


def our_data(tuples):
    """The commands that make the tables."""
    rows = " ".join(f'({a} {p} "{n}")' for a, p, n in seed_rows())
    yield f"let Seed = [const rel(tuple([A: int, P: real, N: string])) value ({rows})]"
    for name, count in (("Big", tuples), ("Small", tuples // 10), ("Tiny", SEED_ROWS)):
        yield (
            f"let {name} = Seed feed {{l}} filter[.A_l < {count // SEED_ROWS}] Seed feed {{r}} product "
            f"projectextend[; Id: .A_l * {SEED_ROWS} + .A_r, "
            "K: (.A_l * 617 + .A_r * 283 + (.A_l * .A_r) mod 7919) mod 1000, "
            "X: ((.A_l * 16807 + .A_r * 48271 + .A_l * .A_r * 37) mod 1048573) * 0.0009765625, "
            "G: (.A_l * 7919 + .A_r * 10007 + (.A_l * .A_r) mod 104729) mod 100003, "
            "Name: .N_l + .N_r] consume"
        )
    yield "let Big_G = Big createbtree[G]"


def sqlite_data(tuples):
    """The same as SQL. The log and the syncs are those that our store has."""
    yield "PRAGMA journal_mode = WAL"
    yield "CREATE TABLE seed(A INTEGER, P REAL, N TEXT)"
    yield "INSERT INTO seed VALUES " + ", ".join(f"({a}, {p}, '{n}')" for a, p, n in seed_rows())
    for name, count in (("big", tuples), ("small", tuples // 10), ("tiny", SEED_ROWS)):
        yield f"CREATE TABLE {name}(Id INTEGER, K INTEGER, X REAL, G INTEGER, Name TEXT)"
        yield (
            f"INSERT INTO {name} SELECT l.A * {SEED_ROWS} + r.A, "
            "(l.A * 617 + r.A * 283 + (l.A * r.A) % 7919) % 1000, "
            "((l.A * 16807 + r.A * 48271 + l.A * r.A * 37) % 1048573) * 0.0009765625, "
            "(l.A * 7919 + r.A * 10007 + (l.A * r.A) % 104729) % 100003, "
            "l.N || r.N FROM seed l CROSS JOIN seed r "
            f"WHERE l.A < {count // SEED_ROWS} ORDER BY l.A, r.A"
        )
    yield "CREATE INDEX big_g ON big(G)"


SORTED = "USE TEMP B-TREE FOR ORDER BY"
HASHED = "AUTOMATIC COVERING INDEX"
# In sqlite3 every table is read by its rows, never by an index that happens to hold what is asked for.
BIG = "big NOT INDEXED"
COPY = ("let Copy = Big feed consume", "CREATE TABLE copy AS SELECT * FROM big")
DELETE_COPY = ("delete Copy", "DROP TABLE copy")


def cases(tuples):
    """One case per operator, in the order of the table."""
    yield from scan_cases(tuples)
    yield from sort_cases()
    yield from join_cases()
    yield from set_cases(tuples)
    yield from aggregate_cases()
    yield from change_cases()
    yield from index_cases()


def scan_cases(tuples):
    yield Case("count", "query Big feed count", f"SELECT count(*) FROM {BIG}",
               proof=(f"query Big feed nth[{tuples // 50}] consume",
                      f"SELECT * FROM {BIG} WHERE (Id + 1) % {tuples // 50} = 0"))
    yield Case("scan of a string", "query Big feed filter[isdefined(.Name)] count", f"SELECT count(Name) FROM {BIG}")
    yield Case("filter", "query Big feed filter[.K < 100] count",
               f"SELECT count(Name) FROM {BIG} WHERE K < 100")
    yield Case("filter, 3 terms", 'query Big feed filter[(.K < 500) and (.X > 100.0) and (.Name > "m")] count',
               f"SELECT count(Name) FROM {BIG} WHERE K < 500 AND X > 100.0 AND Name > 'm'")
    yield Case("extend, avg", "query Big feed extend[Y: .X * 2.0 + .K] avg[Y]",
               f"SELECT avg(Y) FROM (SELECT *, X * 2.0 + K AS Y FROM {BIG} LIMIT -1)")
    yield Case("project", "query Big feed project[Name, Id] count",
               f"SELECT count(Name) FROM (SELECT Name, Id FROM {BIG} LIMIT -1)")


def sort_cases():
    yield Case("sortby", "query Big feed sortby[X] count",
               f"SELECT count(Name) FROM (SELECT * FROM {BIG} ORDER BY X)", plan=SORTED,
               proof=("query Big feed sortby[X, Id] tail[50] consume",
                      "SELECT * FROM (SELECT * FROM big ORDER BY X DESC, Id DESC LIMIT 50) ORDER BY X, Id"))
    yield Case("sortby, string", "query Big feed sortby[Name] count",
               f"SELECT count(Name) FROM (SELECT * FROM {BIG} ORDER BY Name)", plan=SORTED,
               proof=("query Big feed sortby[Name, Id] head[50] consume",
                      "SELECT * FROM big ORDER BY Name, Id LIMIT 50"))
    yield Case("sortby, 2 keys desc", "query Big feed sortby[K desc, G desc] count",
               f"SELECT count(Name) FROM (SELECT * FROM {BIG} ORDER BY K DESC, G DESC)", plan=SORTED,
               proof=("query Big feed sortby[K desc, G desc, Id] head[50] consume",
                      "SELECT * FROM big ORDER BY K DESC, G DESC, Id LIMIT 50"))
    yield Case("sort", "query Big feed project[K, G, X, Name] sort count",
               f"SELECT count(Name) FROM (SELECT K, G, X, Name FROM {BIG} ORDER BY K, G, X, Name)", plan=SORTED,
               proof=("query Big feed project[K, G, X, Name] sort head[50] consume",
                      "SELECT K, G, X, Name FROM big ORDER BY K, G, X, Name LIMIT 50"))
    yield Case("sortby, head[10]", "query Big feed sortby[X, Id] head[10] consume",
               f"SELECT * FROM {BIG} ORDER BY X, Id LIMIT 10", plan=SORTED)
    yield Case("sort rdup", "query Big feed project[K, G] sort rdup count",
               f"SELECT count(G) FROM (SELECT DISTINCT K, G FROM {BIG} ORDER BY K, G)", plan="TEMP B-TREE")
    yield Case("krduph", "query Big feed project[G] krduph[G] count",
               f"SELECT count(G) FROM (SELECT DISTINCT G FROM {BIG})", plan="TEMP B-TREE")
    yield Case("groupby", "query Big feed sortby[K] groupby[K; N: group count, S: group feed sum[G]] consume",
               f"SELECT K, count(*), sum(G) FROM {BIG} GROUP BY K", plan="TEMP B-TREE FOR GROUP BY")


def join_cases():
    # Both sides are read: counts of their last attributes, which are the same.
    pairs = "count(b.Name) + count(s.Name) - count(*)"
    equi = f"SELECT {pairs} FROM big b NOT INDEXED JOIN small s ON b.G = s.Id"
    proof = ("query Big feed Small feed {s} hashjoin[G, Id_s] sortby[X, Id] head[50] consume",
             "SELECT * FROM big b JOIN small s ON b.G = s.Id ORDER BY b.X, b.Id LIMIT 50")
    yield Case("hashjoin", "query Big feed Small feed {s} hashjoin[G, Id_s] count", equi, plan=HASHED, proof=proof)
    yield Case("sortmergejoin", "query Big feed Small feed {s} sortmergejoin[G, Id_s] count", equi, plan=HASHED)
    yield Case("mergejoin", "query Big feed sortby[G] Small feed {s} mergejoin[G, Id_s] count", equi, plan=HASHED)
    yield Case("symmjoin, 1000 x 1000", "query Tiny feed Tiny feed {s} symmjoin[.K < ..K_s] count",
               f"SELECT {pairs} FROM tiny b JOIN tiny s ON b.K < s.K")
    yield Case("loopjoin, 300 x 1000",
               "query Tiny feed head[300] loopjoin[fun(t: TUPLE) Tiny feed {s} filter[.K_s > attr(t, K)]] count",
               f"SELECT {pairs} FROM (SELECT * FROM tiny LIMIT 300) b CROSS JOIN tiny s ON s.K > b.K")
    # Joins that plans are rewritten for: conditions of equality, and an index whose other operand is of the outer tuple.
    yield Case("product filter, equality", "query Tiny feed head[50] Small feed {s} product filter[.G = .Id_s] count",
               f"SELECT {pairs} FROM (SELECT * FROM tiny LIMIT 50) b CROSS JOIN small s ON b.G = s.Id")
    yield Case("symmjoin, equality", "query Tiny feed head[50] Small feed {s} symmjoin[.G = ..Id_s] count",
               f"SELECT {pairs} FROM (SELECT * FROM tiny LIMIT 50) b CROSS JOIN small s ON b.G = s.Id")
    yield Case("loopsel, by an index",
               "query Tiny feed head[50] loopsel[fun(t: TUPLE) Big feed filter[.G = attr(t, K)]] count",
               "SELECT count(b.Name) FROM (SELECT * FROM tiny LIMIT 50) t CROSS JOIN big b ON b.G = t.K",
               plan="USING INDEX big_g")
    yield Case("product, 1000 x 1000", "query Tiny feed Tiny feed {s} product count",
               f"SELECT {pairs} FROM tiny b CROSS JOIN tiny s")


def set_cases(tuples):
    yield Case("concat", "query Big feed Big feed concat count",
               f"SELECT count(Name) FROM (SELECT * FROM {BIG} UNION ALL SELECT * FROM {BIG})")
    both = "query Big feed project[G, K] sort rdup Small feed project[G, K] sort rdup {} {}"
    sets = "SELECT {} FROM (SELECT G, K FROM " + BIG + " {} SELECT G, K FROM small){}"
    for operator, word in (("mergesec", "INTERSECT"), ("mergediff", "EXCEPT"), ("mergeunion", "UNION")):
        yield Case(operator, both.format(operator, "count"), sets.format("count(G)", word, ""), plan="TEMP B-TREE",
                   proof=(both.format(operator, "tail[50] consume"),
                          "SELECT * FROM (" + sets.format("*", word, " ORDER BY G DESC, K DESC LIMIT 50")
                          + ") ORDER BY G, K"))
    yield Case("head", f"query Big feed head[{tuples // 2}] count",
               f"SELECT count(Name) FROM (SELECT * FROM {BIG} LIMIT {tuples // 2})")
    yield Case("tail", "query Big feed tail[1000] consume",
               f"SELECT * FROM {BIG} LIMIT -1 OFFSET {tuples - 1000}")


def aggregate_cases():
    yield Case("min", "query Big feed min[X]", f"SELECT min(X) FROM {BIG}")
    yield Case("max, string", "query Big feed max[Name]", f"SELECT max(Name) FROM {BIG}")
    yield Case("avg", "query Big feed avg[X]", f"SELECT avg(X) FROM {BIG}")
    yield Case("sum", "query Big feed sum[K]", f"SELECT sum(K) FROM {BIG}")


def change_cases():
    size = "SELECT count(Name), sum(K), avg(X) FROM copy NOT INDEXED"
    our_size = ("query Copy feed groupby[; N: group count, K: group feed sum[K], X: group feed avg[X]] consume")
    yield Case("let ... consume", COPY[0], COPY[1], clean=DELETE_COPY)  # its answer is proved by the next
    yield Case("insert", "query Small feed Copy insert count", "INSERT INTO copy SELECT * FROM small; SELECT changes()",
               prepare=COPY, proof=(our_size, size))
    yield Case("updatedirect, a tenth", "query Copy feed filter[.K < 100] Copy updatedirect[X: .X + 1.0] count",
               "UPDATE copy SET X = X + 1.0 WHERE K < 100; SELECT changes()", proof=(our_size, size))
    yield Case("deletedirect, a twentieth", "query Copy feed filter[(.K div 50) = {run}] Copy deletedirect count",
               "DELETE FROM copy WHERE K / 50 = {run}; SELECT changes()", proof=(our_size, size), finish=DELETE_COPY)


def index_cases():
    ours, sqlite = "query Big_G Big range[5000, 5999] count", "SELECT count(Name) FROM big WHERE G BETWEEN 5000 AND 5999"
    yield Case("range, first use", ours, sqlite, plan="USING INDEX big_g")
    yield Case("range, 100 times", ours, sqlite, plan="USING INDEX big_g", repeat=100)


MEMORY_QUERIES = {
    "sort": "query Big feed project[K, G, X, Name] sort count",
    "hashjoin": "query Big feed Big feed {s} hashjoin[Id, Id_s] count",
    "groupby": "query Big feed sortby[G] groupby[G; N: group count] count",
    "sort rdup": "query Big feed project[K, G] sort rdup count",
    "krduph": "query Big feed krduph[Name] count",
    "consume": "query Big feed consume feed count",
}
