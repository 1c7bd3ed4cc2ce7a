\echo Use "CREATE EXTENSION algebra3d_shards" to load this file. \quit

-- Relations over several servers (docs/scaling.md). A relation R becomes a partitioned table R_tiles of foreign tables, one
-- for each tile of a grid, and a view R. An object lies in each tile that its box meets; `home` marks the copy in the tile
-- of the box's low corner. Commit (decision 0031): each tile has a generation, which every write transaction raises on
-- its server and here; a row says in which generation it was born, in which it died, and which statement wrote it. What this server has committed
-- holds: queries compare generations, and algebra3d_shard_repair takes a tile back to the one that is known here.

DO $$
BEGIN
  IF (SELECT extnamespace FROM pg_catalog.pg_extension WHERE extname = 'algebra3d') <> '@extschema@'::regnamespace THEN
    RAISE 'algebra3d_shards must be in the schema of algebra3d, since remote statements name both'
      USING ERRCODE = 'invalid_schema_definition', HINT = (SELECT format('CREATE EXTENSION algebra3d_shards SCHEMA %I', n.nspname)
        FROM pg_catalog.pg_extension e JOIN pg_catalog.pg_namespace n ON n.oid = e.extnamespace WHERE e.extname = 'algebra3d');
  END IF;
END $$;

---- Grids ----

CREATE TYPE grid;
CREATE FUNCTION grid_in(cstring) RETURNS grid AS 'MODULE_PATHNAME', 'algebra3d_grid_in' LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE;
CREATE FUNCTION grid_out(grid) RETURNS cstring AS 'MODULE_PATHNAME', 'algebra3d_grid_out' LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE;
CREATE TYPE grid (INPUT = grid_in, OUTPUT = grid_out, INTERNALLENGTH = VARIABLE, ALIGNMENT = double, STORAGE = PLAIN);
COMMENT ON TYPE grid IS 'Tiles that divide space: (cells CORNER SIZE COUNTS), or (ranges CORNER SIZE ENDS) of Hilbert''s curve; then (TILE AXIS PLACE) for each that was divided.';

CREATE FUNCTION grid(extent rect3, counts integer[]) RETURNS grid AS 'MODULE_PATHNAME', 'algebra3d_grid_of_cells' LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE;
COMMENT ON FUNCTION grid(rect3, integer[]) IS 'Tiles that are cells: a box divided evenly into so many along x, y and z.';
CREATE FUNCTION grid(sample rect3[], tiles integer) RETURNS grid AS 'MODULE_PATHNAME', 'algebra3d_grid_of_sample' LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE;
COMMENT ON FUNCTION grid(rect3[], integer) IS 'Tiles with equal shares of a sample of boxes: ranges of Hilbert''s curve.';
CREATE FUNCTION grid(grid, tile integer, axis text, place float8) RETURNS grid AS 'MODULE_PATHNAME', 'algebra3d_grid_divided' LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE;
COMMENT ON FUNCTION grid(grid, integer, text, float8) IS 'A grid with one tile divided: what lies at a place or above on the axis x, y or z gets the next number.';
CREATE FUNCTION tile_count(grid) RETURNS integer AS 'MODULE_PATHNAME', 'algebra3d_grid_tile_count' LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE;
COMMENT ON FUNCTION tile_count(grid) IS 'The number of tiles; they are numbered from 0.';
CREATE FUNCTION tile_of(place point3d, grid) RETURNS integer AS 'MODULE_PATHNAME', 'algebra3d_tile_of_point' LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE;
COMMENT ON FUNCTION tile_of(point3d, grid) IS 'The tile of a point; places outside of the grid belong to its outermost tiles.';
CREATE FUNCTION tile_of(box rect3, grid) RETURNS integer AS 'MODULE_PATHNAME', 'algebra3d_tile_of_box' LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE;
COMMENT ON FUNCTION tile_of(rect3, grid) IS 'The tile of the low corner of a box.';
CREATE FUNCTION tiles_of(box rect3, grid, reach float8 DEFAULT 0) RETURNS integer[] AS 'MODULE_PATHNAME', 'algebra3d_tiles_of' LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE;
COMMENT ON FUNCTION tiles_of(rect3, grid, float8) IS 'The tiles that a box meets that has half of the reach more on each side, ascending.';
CREATE FUNCTION pair_tile(a rect3, b rect3, grid, reach float8 DEFAULT 0) RETURNS integer AS 'MODULE_PATHNAME', 'algebra3d_pair_tile' LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE;
COMMENT ON FUNCTION pair_tile(rect3, rect3, grid, float8) IS 'The one tile in which a pair counts: that of the low corner of what both boxes, with half of the reach more on each side, have in common; NULL if they have nothing.';
CREATE FUNCTION is_pair_tile(tile integer, a rect3, b rect3, grid, reach float8 DEFAULT 0) RETURNS boolean AS 'MODULE_PATHNAME', 'algebra3d_is_pair_tile' LANGUAGE C IMMUTABLE STRICT PARALLEL SAFE;
COMMENT ON FUNCTION is_pair_tile(integer, rect3, rect3, grid, float8) IS 'Whether that is this tile; the planner expects it of a third of the pairs.';

---- Sums ----

CREATE FUNCTION exact_sum_add(internal, float8) RETURNS internal AS 'MODULE_PATHNAME', 'algebra3d_exact_sum_add' LANGUAGE C IMMUTABLE PARALLEL SAFE;
CREATE FUNCTION exact_sum_add(internal, float8[]) RETURNS internal AS 'MODULE_PATHNAME', 'algebra3d_exact_sum_add_parts' LANGUAGE C IMMUTABLE PARALLEL SAFE;
CREATE FUNCTION exact_sum_finish(internal) RETURNS float8 AS 'MODULE_PATHNAME', 'algebra3d_exact_sum' LANGUAGE C IMMUTABLE PARALLEL SAFE;
CREATE FUNCTION exact_sum_parts_finish(internal) RETURNS float8[] AS 'MODULE_PATHNAME', 'algebra3d_exact_sum_parts' LANGUAGE C IMMUTABLE PARALLEL SAFE;
CREATE AGGREGATE exact_sum(float8) (SFUNC = exact_sum_add, STYPE = internal, SSPACE = 528, FINALFUNC = exact_sum_finish, PARALLEL = SAFE);
COMMENT ON AGGREGATE exact_sum(float8) IS 'The exact sum, rounded once to the nearest double: the same in any order; NULL if there is no value.';
CREATE AGGREGATE exact_sum(float8[]) (SFUNC = exact_sum_add, STYPE = internal, SSPACE = 528, FINALFUNC = exact_sum_finish, PARALLEL = SAFE);
COMMENT ON AGGREGATE exact_sum(float8[]) IS 'The exact sum of parts of sums, rounded once.';
CREATE AGGREGATE exact_sum_parts(float8) (SFUNC = exact_sum_add, STYPE = internal, SSPACE = 528, FINALFUNC = exact_sum_parts_finish, PARALLEL = SAFE);
COMMENT ON AGGREGATE exact_sum_parts(float8) IS 'Some doubles whose sum is the exact sum, to be summed further by exact_sum.';

---- What is known ----

CREATE TABLE algebra3d_shard_relations (
  relation text PRIMARY KEY,      -- qualified and quoted, as in SQL; after that, (N) if it was divided anew N times
  schema_name name NOT NULL,
  name name NOT NULL,
  geometry name NOT NULL,         -- the column in space, and its type
  geometry_type text NOT NULL,
  columns name[] NOT NULL,
  grid grid NOT NULL,
  reach float8 NOT NULL,          -- the greatest distance of a distance join
  fewest_tiles integer NOT NULL DEFAULT 0,     -- of a grid for which a statement may have been planned
  split_tiles integer[] NOT NULL DEFAULT '{}'  -- those that still have copies which no statement needs any more
);
-- Of which relations algebra3d_shard_join made views.
CREATE TABLE algebra3d_shard_joins (
  a text NOT NULL REFERENCES algebra3d_shard_relations ON DELETE CASCADE,
  b text NOT NULL REFERENCES algebra3d_shard_relations ON DELETE CASCADE,
  PRIMARY KEY (a, b)
);
CREATE TABLE algebra3d_shard_tiles (
  relation text NOT NULL REFERENCES algebra3d_shard_relations ON DELETE CASCADE,
  tile integer NOT NULL,
  server name NOT NULL,
  generation bigint NOT NULL DEFAULT 0,
  writer xid8,                    -- the last transaction that wrote, and the one before
  writer_before xid8,
  PRIMARY KEY (relation, tile)
);
-- Numbers of transactions that come from a dump mean nothing here.
CREATE FUNCTION algebra3d_shard_restored() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
  IF NEW.writer IS DISTINCT FROM pg_catalog.pg_current_xact_id() THEN
    NEW.writer := NULL;
  END IF;
  NEW.writer_before := NULL;
  RETURN NEW;
END $$;
CREATE TRIGGER restored BEFORE INSERT ON algebra3d_shard_tiles FOR EACH ROW EXECUTE FUNCTION algebra3d_shard_restored();
-- On a shard: the generations of its tiles. On the coordinator it is empty.
CREATE TABLE algebra3d_shard_generations (
  relation text NOT NULL,
  tile integer NOT NULL,
  generation bigint NOT NULL,
  PRIMARY KEY (relation, tile)
);
-- On a shard: a statement that is inserted is run, with the rights of who inserts it, and in his transaction.
CREATE TABLE algebra3d_shard_statements (statement text);
CREATE FUNCTION algebra3d_shard_run() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
  EXECUTE NEW.statement;
  RETURN NULL;
END $$;
CREATE TRIGGER run BEFORE INSERT ON algebra3d_shard_statements FOR EACH ROW EXECUTE FUNCTION algebra3d_shard_run();
-- The generated columns of a table, as definitions.
CREATE FUNCTION algebra3d_shard_generated(source regclass) RETURNS text[] LANGUAGE SQL STABLE
SET search_path = pg_catalog, pg_temp AS $$
  SELECT array_agg(format('%I %s GENERATED ALWAYS AS (%s) STORED', a.attname, format_type(a.atttypid, a.atttypmod), pg_get_expr(d.adbin, d.adrelid)) ORDER BY a.attname)
  FROM pg_attribute a JOIN pg_attrdef d ON d.adrelid = a.attrelid AND d.adnum = a.attnum WHERE a.attrelid = source AND a.attgenerated = 's'
$$;
-- On a shard: its tables that are tiles, for algebra3d_shard_check.
CREATE VIEW algebra3d_shard_tables AS
  SELECT n.nspname AS schema_name, c.relname AS table_name,
    (SELECT array_agg(pg_get_constraintdef(k.oid)) FROM pg_constraint k WHERE k.conrelid = c.oid AND k.contype = 'c' AND k.convalidated) AS checks,
    EXISTS (SELECT FROM pg_index i JOIN pg_class x ON x.oid = i.indexrelid JOIN pg_am m ON m.oid = x.relam WHERE i.indrelid = c.oid AND m.amname = 'gist' AND i.indisvalid) AS is_indexed,
    algebra3d_shard_generated(c.oid) AS generated
  FROM pg_class c JOIN pg_namespace n ON n.oid = c.relnamespace
  WHERE c.relkind = 'r' AND (SELECT count(*) FROM pg_attribute a WHERE a.attrelid = c.oid AND a.attname IN ('row_id', 'tile', 'home', 'born', 'died', 'stamp')) = 6;
GRANT SELECT ON algebra3d_shard_tables TO PUBLIC;
-- Removes a tile that was left behind; a table that is none stays.
CREATE FUNCTION algebra3d_shard_drop_tile(schema_name name, table_name name) RETURNS void LANGUAGE plpgsql VOLATILE SET lock_timeout = '5s' AS $$
BEGIN
  IF EXISTS (SELECT FROM @extschema@.algebra3d_shard_tables t WHERE (t.schema_name, t.table_name) = ($1, $2)) THEN
    EXECUTE format('DROP TABLE %I.%I', schema_name, table_name);
  END IF;
END $$;
SELECT pg_catalog.pg_extension_config_dump('algebra3d_shard_relations', '');
SELECT pg_catalog.pg_extension_config_dump('algebra3d_shard_joins', '');
SELECT pg_catalog.pg_extension_config_dump('algebra3d_shard_tiles', '');
SELECT pg_catalog.pg_extension_config_dump('algebra3d_shard_generations', '');
GRANT SELECT ON algebra3d_shard_relations, algebra3d_shard_joins, algebra3d_shard_tiles, algebra3d_shard_generations TO PUBLIC;
-- The extension is trusted: who creates it need not be a superuser, and keeps its tables.
GRANT ALL ON algebra3d_shard_relations, algebra3d_shard_joins, algebra3d_shard_tiles, algebra3d_shard_generations, algebra3d_shard_statements TO @extowner@;

-- The row of a relation, or an error.
CREATE FUNCTION algebra3d_shard_relation(relation text) RETURNS algebra3d_shard_relations LANGUAGE plpgsql STABLE
SET search_path = @extschema@, pg_temp AS $$
DECLARE
  known algebra3d_shard_relations;
  wanted name[];
BEGIN
  SELECT r.* INTO known FROM algebra3d_shard_relations r WHERE r.relation = $1;
  IF FOUND THEN
    RETURN known;
  END IF;
  wanted := parse_ident(relation);
  SELECT r.* INTO known FROM algebra3d_shard_relations r
    WHERE r.name = wanted[cardinality(wanted)] AND (cardinality(wanted) = 1 OR r.schema_name = wanted[1]);
  IF NOT FOUND THEN
    RAISE 'no relation % is divided into tiles', relation USING ERRCODE = 'undefined_table',
      HINT = 'algebra3d_shard_create divides one; the table algebra3d_shard_relations has those that are.';
  END IF;
  RETURN known;
END $$;

-- The row of a relation as it stays until the end of the transaction: tiles are divided, moved and exchanged under a lock that waits
-- for this one. Who computes tiles himself begins here.
CREATE FUNCTION algebra3d_shard_known(relation text) RETURNS algebra3d_shard_relations LANGUAGE plpgsql VOLATILE
SET search_path = @extschema@, pg_temp AS $$
DECLARE
  known algebra3d_shard_relations := algebra3d_shard_relation(relation);
BEGIN
  EXECUTE format('LOCK TABLE ONLY %I.%I IN ACCESS SHARE MODE', known.schema_name, known.name || '_tiles');
  SELECT r.* INTO known FROM algebra3d_shard_relations r WHERE (r.schema_name, r.name) = (known.schema_name, known.name);
  RETURN known;
END $$;

---- Reading ----

CREATE FUNCTION algebra3d_kept_in_transaction(text) RETURNS text AS 'MODULE_PATHNAME' LANGUAGE C VOLATILE PARALLEL RESTRICTED;
COMMENT ON FUNCTION algebra3d_kept_in_transaction(text) IS 'The text, not NULL, of the last call in this transaction; NULL if there was none.';
-- Commits over several servers, and the beginnings of reading transactions, exclude each other: these see all of a commit, or nothing.
CREATE FUNCTION algebra3d_shard_take_commits() RETURNS void AS 'MODULE_PATHNAME' LANGUAGE C VOLATILE STRICT;
CREATE FUNCTION algebra3d_shard_share_commits() RETURNS boolean AS 'MODULE_PATHNAME' LANGUAGE C VOLATILE STRICT;
CREATE FUNCTION algebra3d_shard_release_commits() RETURNS void AS 'MODULE_PATHNAME' LANGUAGE C VOLATILE STRICT;
-- At the end of a transaction that writes, before any server commits. It does not wait for ever for one that reads and waits for a server
-- itself: who begins to read then may see half of the commit, and says so.
CREATE FUNCTION algebra3d_shard_lock_commits() RETURNS void LANGUAGE plpgsql VOLATILE AS $$
DECLARE
  before text := pg_catalog.current_setting('lock_timeout');
BEGIN
  BEGIN
    PERFORM pg_catalog.set_config('lock_timeout', '2s', true);
    PERFORM @extschema@.algebra3d_shard_take_commits();
  EXCEPTION WHEN lock_not_available THEN
    NULL;
  END;
  PERFORM pg_catalog.set_config('lock_timeout', before, true);
END $$;
CREATE FUNCTION algebra3d_shard_before_commit() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
  PERFORM @extschema@.algebra3d_shard_lock_commits();
  RETURN NULL;
END $$;
CREATE CONSTRAINT TRIGGER before_commit AFTER INSERT OR UPDATE OR DELETE ON algebra3d_shard_tiles DEFERRABLE INITIALLY DEFERRED
  FOR EACH ROW EXECUTE FUNCTION algebra3d_shard_before_commit();
-- What a transaction has read: generations of tiles on servers, which are those of one snapshot here.
CREATE TYPE algebra3d_shard_state AS (snapshot pg_snapshot, relations text[], tiles integer[], generations bigint[]);

-- The foreign table of generations on a server.
CREATE FUNCTION algebra3d_shard_generations_of(server name) RETURNS text LANGUAGE SQL IMMUTABLE STRICT
RETURN format('%I.%I', '@extschema@', 'algebra3d_generations_' || server);

-- The generations of some tiles (NULL: all) on their servers.
CREATE FUNCTION algebra3d_shard_generations_there(relation text, tiles integer[]) RETURNS TABLE (tile integer, generation bigint) LANGUAGE plpgsql VOLATILE AS $$
DECLARE
  shard name;
  its_tiles integer[];
BEGIN
  FOR shard, its_tiles IN SELECT t.server, array_agg(t.tile) FROM @extschema@.algebra3d_shard_tiles t
               WHERE t.relation = $1 AND ($2 IS NULL OR t.tile = ANY ($2)) GROUP BY 1 ORDER BY 1 LOOP
    RETURN QUERY EXECUTE format('SELECT g.tile, g.generation FROM %s g WHERE g.relation = $1 AND g.tile = ANY ($2)',
      @extschema@.algebra3d_shard_generations_of(shard)) USING $1, its_tiles;
  END LOOP;
END $$;

-- Tiles whose generation here and on its server differ, with both.
CREATE FUNCTION algebra3d_shard_differences(relation text) RETURNS TABLE (tile integer, here bigint, there bigint) LANGUAGE SQL VOLATILE
BEGIN ATOMIC
  SELECT t.tile, t.generation, g.generation FROM algebra3d_shard_generations_there(relation, NULL) g RIGHT JOIN algebra3d_shard_tiles t ON t.tile = g.tile
    WHERE t.relation = $1 AND g.generation IS DISTINCT FROM t.generation ORDER BY t.tile;
END;

-- -1 if what the servers have of some tiles (NULL: all), and of all that this transaction has read before, is what one snapshot has
-- here, else an error. Remote statements see what was committed on each server when the first one of their transaction came there.
-- `planned_tiles` are those of the grid for which the statement was planned.
CREATE FUNCTION algebra3d_shard_ready(relation text, tiles integer[] DEFAULT NULL, planned_tiles integer DEFAULT NULL) RETURNS integer LANGUAGE plpgsql VOLATILE
SET search_path = @extschema@, pg_temp AS $$
DECLARE
  fewest integer := (SELECT r.fewest_tiles FROM algebra3d_shard_relations r WHERE r.relation = $1);
  own xid8 := pg_current_xact_id_if_assigned();
  seen algebra3d_shard_state := algebra3d_kept_in_transaction(NULL)::algebra3d_shard_state;
  first pg_snapshot;
  is_shared boolean;
  other record;
BEGIN
  IF fewest IS NULL OR planned_tiles < fewest THEN
    RAISE '% was divided while the statement was planned', relation USING ERRCODE = 'serialization_failure', HINT = 'Run it again.';
  END IF;
  -- A commit that has stopped is said below.
  FOR attempt IN 1 .. 200 LOOP
    is_shared := algebra3d_shard_share_commits();
    EXIT WHEN is_shared;
    PERFORM pg_sleep(0.01);
  END LOOP;
  first := coalesce(seen.snapshot, pg_current_snapshot());
  SELECT first, array_agg(q.relation), array_agg(q.tile), array_agg(q.generation) INTO seen.snapshot, seen.relations, seen.tiles, seen.generations FROM (
    SELECT s.relation, s.tile, s.generation FROM unnest(seen.relations, seen.tiles, seen.generations) s(relation, tile, generation)
      WHERE NOT (s.relation = $1 AND ($2 IS NULL OR s.tile = ANY ($2)))
    UNION ALL
    SELECT $1, t.tile, g.generation FROM algebra3d_shard_tiles t LEFT JOIN algebra3d_shard_generations_there($1, $2) g ON g.tile = t.tile
      WHERE t.relation = $1 AND ($2 IS NULL OR t.tile = ANY ($2))) q;
  IF is_shared THEN
    PERFORM algebra3d_shard_release_commits();
  END IF;
  -- Commits that are under way are waited for above, but for one that could not wait for all readers.
  FOR attempt IN 1 .. CASE WHEN is_shared THEN 5 ELSE 100 END LOOP
    SELECT * INTO other FROM (
      SELECT t.relation, t.tile, t.generation, t.writer, t.writer_before, s.generation AS there, s.relation = $1 AND ($2 IS NULL OR s.tile = ANY ($2)) AS is_new,
        CASE WHEN t.writer IS NULL OR t.writer = own OR pg_visible_in_snapshot(t.writer, seen.snapshot) THEN t.generation
          WHEN t.writer_before IS NULL OR pg_visible_in_snapshot(t.writer_before, seen.snapshot) THEN t.generation - 1 END AS expected
      FROM unnest(seen.relations, seen.tiles, seen.generations) s(relation, tile, generation) JOIN algebra3d_shard_tiles t USING (relation, tile)) q
      -- What was read before this transaction wrote it is not read again.
      WHERE q.there IS DISTINCT FROM q.expected AND (q.is_new OR q.writer IS DISTINCT FROM own) ORDER BY q.there - q.generation NULLS FIRST LIMIT 1;
    IF NOT FOUND THEN
      PERFORM algebra3d_kept_in_transaction(seen::text);
      RETURN -1;
    END IF;
    -- Later snapshots have no earlier generations.
    EXIT WHEN other.there IS NULL OR other.there < other.generation;
    IF attempt > 1 THEN
      PERFORM pg_sleep(0.02);
    END IF;
    seen.snapshot := pg_current_snapshot();
  END LOOP;
  IF coalesce(other.there, 0) < other.generation THEN
    IF coalesce(pg_visible_in_snapshot(CASE WHEN other.writer = own THEN other.writer_before ELSE other.writer END, first), true) THEN
      RAISE 'tile % of % is at generation % on its server, expected %: an older copy', other.tile, other.relation,
        coalesce(other.there, 0), other.generation USING ERRCODE = 'data_corrupted',
        HINT = 'The server may have been restored from a backup; see SELECT * FROM algebra3d_shard_check().';
    END IF;
  ELSIF current_setting('transaction_isolation') = 'read committed' THEN
    RAISE 'a transaction over several servers was not completed on the one of tile % of %', other.tile, other.relation
      USING ERRCODE = 'object_not_in_prerequisite_state', HINT = 'SELECT * FROM algebra3d_shard_repair() takes back what was not committed.';
  END IF;
  RAISE 'others have written into tile % of % since this transaction began to read', other.tile, other.relation USING ERRCODE = 'serialization_failure',
    HINT = 'Begin the transaction again. It sees each server as it was at its first statement there.';
END $$;
COMMENT ON FUNCTION algebra3d_shard_ready(text, integer[], integer) IS 'An error unless the servers of these tiles, NULL: of all, have what was committed here.';

---- Writing ----

-- What beginning to write into some tiles is here: each that the present transaction does not write yet gets a new generation.
-- Its server, which is to get the same, and the generation.
CREATE FUNCTION algebra3d_shard_claim(relation text, tiles integer[]) RETURNS TABLE (tile integer, server name, generation bigint)
LANGUAGE plpgsql VOLATILE AS $$
DECLARE
  one integer;
BEGIN
  FOR one IN SELECT DISTINCT t FROM unnest(tiles) t LOOP
    IF NOT pg_catalog.pg_try_advisory_xact_lock_shared(pg_catalog.hashtext('algebra3d ' || $1), one) THEN
      RAISE 'tile % of % is being moved', one, $1 USING ERRCODE = 'lock_not_available',
        HINT = 'Try again when algebra3d_shard_move, algebra3d_shard_split or algebra3d_shard_divide has ended.';
    END IF;
  END LOOP;
  -- In one order in all transactions, so that they do not wait for each other.
  PERFORM FROM @extschema@.algebra3d_shard_tiles t WHERE t.relation = $1 AND t.tile = ANY ($2) ORDER BY t.tile FOR UPDATE;
  RETURN QUERY UPDATE @extschema@.algebra3d_shard_tiles t SET generation = t.generation + 1, writer = pg_catalog.pg_current_xact_id(), writer_before = t.writer
    WHERE t.relation = $1 AND t.tile = ANY ($2) AND t.writer IS DISTINCT FROM pg_catalog.pg_current_xact_id()
    RETURNING t.tile, t.server, t.generation;
END $$;

-- Begins to write into some tiles, in the present transaction: each gets a new generation here and on its server, and rows
-- that died in earlier ones go.
CREATE FUNCTION algebra3d_shard_begin(relation text, tiles integer[]) RETURNS void LANGUAGE plpgsql VOLATILE AS $$
DECLARE
  known @extschema@.algebra3d_shard_relations;
  one record;
  touched bigint;
BEGIN
  IF NOT EXISTS (SELECT FROM @extschema@.algebra3d_shard_tiles t WHERE t.relation = $1 AND t.tile = ANY ($2)
                 AND t.writer IS DISTINCT FROM pg_catalog.pg_current_xact_id()) THEN
    RETURN;
  END IF;
  known := @extschema@.algebra3d_shard_relation(relation);
  FOR one IN SELECT * FROM @extschema@.algebra3d_shard_claim($1, $2) LOOP
    EXECUTE format('UPDATE %s SET generation = $3 WHERE relation = $1 AND tile = $2 AND generation = $3 - 1',
                   @extschema@.algebra3d_shard_generations_of(one.server)) USING $1, one.tile, one.generation;
    GET DIAGNOSTICS touched = ROW_COUNT;
    IF touched <> 1 THEN
      PERFORM @extschema@.algebra3d_shard_ready($1, ARRAY[one.tile]);
      RAISE 'tile % of % is at another generation on its server than %', one.tile, $1, one.generation - 1
        USING ERRCODE = 'object_not_in_prerequisite_state', HINT = 'SELECT * FROM algebra3d_shard_repair()';
    END IF;
    EXECUTE format('DELETE FROM %I.%I WHERE tile = $1 AND died IS NOT NULL', known.schema_name, known.name || '_tiles') USING one.tile;
  END LOOP;
END $$;

-- The tiles of a box, and its home; a value without a box is in tile 0.
CREATE FUNCTION algebra3d_shard_tiles_of(box rect3, grid grid, reach float8) RETURNS integer[] LANGUAGE SQL IMMUTABLE
RETURN coalesce(tiles_of(box, grid, reach), ARRAY[0]);
CREATE FUNCTION algebra3d_shard_home_of(box rect3, grid grid) RETURNS integer LANGUAGE SQL IMMUTABLE
RETURN coalesce(tile_of(box, grid), 0);

-- What `algebra3d push --shards` asks, which writes into the tiles over connections of its own: for each of some boxes a new number
-- of a row, its tiles, and its home; and how a server is reached.
CREATE FUNCTION algebra3d_shard_places(relation text, boxes rect3[]) RETURNS TABLE (row_id bigint, tiles integer[], home integer) LANGUAGE plpgsql VOLATILE
SET search_path = @extschema@, pg_temp AS $$
DECLARE
  known algebra3d_shard_relations := algebra3d_shard_known(relation);
BEGIN
  RETURN QUERY SELECT nextval(format('%I.%I', known.schema_name, known.name || '_row_id')::regclass),
    algebra3d_shard_tiles_of(b.box, known.grid, known.reach), algebra3d_shard_home_of(b.box, known.grid)
    FROM unnest(boxes) WITH ORDINALITY b(box, n) ORDER BY b.n;
END $$;
-- As a conninfo of libpq: the options that are not those of postgres_fdw itself.
CREATE FUNCTION algebra3d_shard_conninfo(server name) RETURNS text LANGUAGE SQL STABLE
SET search_path = pg_catalog, pg_temp AS $$
  WITH options AS (
    SELECT o.* FROM pg_foreign_server s, pg_options_to_table(s.srvoptions) o WHERE s.srvname = $1
    UNION ALL
    SELECT o.* FROM (SELECT u.umoptions FROM pg_user_mappings u WHERE u.srvname = $1 AND u.usename IN (current_user, 'public')
                     ORDER BY u.usename = current_user DESC LIMIT 1) m, pg_options_to_table(m.umoptions) o)
  SELECT string_agg(format('%s=''%s''', option_name, replace(replace(option_value, '\', '\\'), '''', '\''')), ' ') FROM (
    SELECT * FROM options WHERE option_name NOT IN ('use_remote_estimate', 'fdw_startup_cost', 'fdw_tuple_cost', 'extensions', 'updatable', 'truncatable',
      'fetch_size', 'batch_size', 'async_capable', 'parallel_commit', 'parallel_abort', 'analyze_sampling', 'keep_connections', 'password_required')
    UNION ALL
    SELECT 'user', current_user WHERE NOT EXISTS (SELECT FROM options WHERE option_name = 'user')) q
$$;

-- Before each statement that writes into a view: its number.
CREATE FUNCTION algebra3d_shard_stamp() RETURNS trigger LANGUAGE plpgsql VOLATILE AS $$
BEGIN
  PERFORM pg_catalog.set_config('algebra3d_shards.stamp', nextval(TG_ARGV[0]::regclass)::text, true);
  RETURN NULL;
END $$;

-- INSTEAD OF INSERT, UPDATE and DELETE of a view. A scan that goes on while rows are written
-- comes upon those that went into its later tiles: their number tells them.
CREATE FUNCTION algebra3d_shard_write() RETURNS trigger LANGUAGE plpgsql VOLATILE AS $$
DECLARE
  known @extschema@.algebra3d_shard_relations := @extschema@.algebra3d_shard_known(format('%I.%I', TG_TABLE_SCHEMA, TG_TABLE_NAME));
  parent text := format('%I.%I', known.schema_name, known.name || '_tiles');
  box_of text := format('CASE WHEN ($1).%1$I IS NULL THEN NULL WHEN NOT @extschema@.is_empty(($1).%1$I) THEN @extschema@.bbox(($1).%1$I) END', known.geometry);
  old_tiles integer[] := '{}';
  new_tiles integer[] := '{}';
  box @extschema@.rect3;
  columns text := (SELECT string_agg(format('%I', c), ', ') FROM unnest(known.columns) c);
  cells text := (SELECT string_agg(format('($1).%I', c), ', ') FROM unnest(known.columns) c);
  row_id bigint;
  stamp bigint := pg_catalog.current_setting('algebra3d_shards.stamp');
  touched bigint;
  found_one boolean := TG_OP = 'INSERT';
  one record;
BEGIN
  IF TG_OP <> 'INSERT' THEN
    EXECUTE 'SELECT ' || box_of INTO box USING OLD;
    old_tiles := @extschema@.algebra3d_shard_tiles_of(box, known.grid, known.reach);
    row_id := OLD.row_id;
  END IF;
  IF TG_OP <> 'DELETE' THEN
    EXECUTE 'SELECT ' || box_of INTO box USING NEW;
    new_tiles := @extschema@.algebra3d_shard_tiles_of(box, known.grid, known.reach);
    IF TG_OP = 'INSERT' THEN
      row_id := nextval(format('%I.%I', known.schema_name, known.name || '_row_id')::regclass);
    END IF;
    NEW.row_id := row_id;
  END IF;
  PERFORM @extschema@.algebra3d_shard_begin(known.relation, old_tiles || new_tiles);
  FOR one IN SELECT t.tile, t.generation FROM @extschema@.algebra3d_shard_tiles t WHERE t.relation = known.relation AND t.tile = ANY (old_tiles) LOOP
    EXECUTE format('UPDATE %s SET died = $1 WHERE tile = $2 AND row_id = $3 AND died IS NULL AND stamp <> $4', parent)
      USING one.generation, one.tile, row_id, stamp;
    GET DIAGNOSTICS touched = ROW_COUNT;
    found_one := found_one OR touched > 0;
  END LOOP;
  IF NOT found_one THEN
    RETURN NULL;
  END IF;
  IF TG_OP = 'DELETE' THEN
    RETURN OLD;
  END IF;
  FOR one IN SELECT t.tile, t.generation FROM @extschema@.algebra3d_shard_tiles t WHERE t.relation = known.relation AND t.tile = ANY (new_tiles) LOOP
    EXECUTE format('INSERT INTO %s (%s, row_id, tile, home, born, stamp) SELECT %s, $2, $3, $4, $5, $6', parent, columns, cells)
      USING NEW, row_id, one.tile, one.tile = @extschema@.algebra3d_shard_home_of(box, known.grid), one.generation, stamp;
  END LOOP;
  RETURN NEW;
END $$;

CREATE FUNCTION algebra3d_shard_load(relation text, source regclass) RETURNS bigint LANGUAGE plpgsql VOLATILE
SET search_path = @extschema@, pg_temp AS $$
DECLARE
  known algebra3d_shard_relations := algebra3d_shard_known(relation);
  columns text := (SELECT string_agg(format('%I', c), ', ') FROM unnest(known.columns) c);
  loaded bigint;
BEGIN
  PERFORM algebra3d_shard_begin(known.relation, (SELECT array_agg(t.tile) FROM algebra3d_shard_tiles t WHERE t.relation = known.relation));
  EXECUTE format(
    'WITH placed AS (SELECT s.*, nextval(%6$L::regclass) AS row_id, CASE WHEN s.%3$I IS NULL THEN NULL WHEN NOT is_empty(s.%3$I) THEN bbox(s.%3$I) END AS box FROM %2$s s), '
    'copies AS (INSERT INTO %4$I.%5$I (%1$s, row_id, tile, home, born, stamp) SELECT %1$s, row_id, t.tile, t.tile = algebra3d_shard_home_of(box, $1), t.generation, $4 '
    'FROM placed, unnest(algebra3d_shard_tiles_of(box, $1, $2)) AS n(tile) JOIN algebra3d_shard_tiles t ON t.relation = $3 AND t.tile = n.tile '
    'RETURNING home) SELECT count(*) FILTER (WHERE home) FROM copies',
    columns, source, known.geometry, known.schema_name, known.name || '_tiles', format('%I.%I', known.schema_name, known.name || '_row_id'))
    INTO loaded USING known.grid, known.reach, known.relation, nextval(format('%I.%I', known.schema_name, known.name || '_row_id')::regclass);
  -- Without statistics a server does not know that sending its count is cheaper than sending its rows.
  PERFORM algebra3d_shard_execute(t.server, format('ANALYZE %I.%I', known.schema_name, algebra3d_shard_tile_name(known, t.tile)))
    FROM algebra3d_shard_tiles t WHERE t.relation = known.relation ORDER BY t.tile;
  RETURN loaded;
END $$;
COMMENT ON FUNCTION algebra3d_shard_load(text, regclass) IS 'Copies the rows of a table with the same columns into the tiles, in this transaction; the number of rows.';

---- Set-up ----

-- The options of a server or of a foreign table that say where it is.
CREATE FUNCTION algebra3d_shard_address(options text[]) RETURNS text LANGUAGE SQL IMMUTABLE
RETURN (SELECT string_agg(o, ',' ORDER BY o) FROM unnest(options) o WHERE o ~ '^(host|hostaddr|port|dbname|schema_name|table_name)=');

-- The foreign tables for what the coordinator asks a server itself.
CREATE FUNCTION algebra3d_shard_server(server name) RETURNS void LANGUAGE plpgsql VOLATILE
SET search_path = @extschema@, pg_temp SET client_min_messages = warning AS $$
DECLARE
  options text[] := (SELECT srvoptions FROM pg_foreign_server WHERE srvname = server);
  extensions text := coalesce((SELECT option_value FROM pg_options_to_table(options) WHERE option_name = 'extensions'), '');
  wanted text := array_to_string(ARRAY(SELECT DISTINCT trim(e) FROM unnest(string_to_array(extensions, ',') || '{algebra3d,algebra3d_shards}') e
                                       WHERE trim(e) <> '' ORDER BY 1), ',');
  setting record;
  helper record;
BEGIN
  IF NOT EXISTS (SELECT FROM pg_foreign_server s JOIN pg_foreign_data_wrapper w ON w.oid = s.srvfdw
                 WHERE s.srvname = server AND w.fdwname = 'postgres_fdw') THEN
    RAISE 'no server % of postgres_fdw', server USING ERRCODE = 'undefined_object',
      HINT = format('CREATE SERVER %I FOREIGN DATA WRAPPER postgres_fdw OPTIONS (host ..., dbname ...); CREATE USER MAPPING FOR ... SERVER %I', server, server);
  END IF;
  IF length('algebra3d_generations_' || server) > 63 THEN
    RAISE 'the name of server % has more than 41 characters', server USING ERRCODE = 'name_too_long';
  END IF;
  FOR setting IN VALUES ('extensions', wanted), ('async_capable', 'true'), ('fdw_tuple_cost', '10') LOOP
    IF EXISTS (SELECT FROM pg_options_to_table(options) WHERE option_name = setting.column1 AND option_value = setting.column2) THEN
      CONTINUE;
    END IF;
    EXECUTE format('ALTER SERVER %I OPTIONS (%s %s %L)', server,
      CASE WHEN EXISTS (SELECT FROM pg_options_to_table(options) WHERE option_name = setting.column1) THEN 'SET' ELSE 'ADD' END,
      setting.column1, setting.column2);
  END LOOP;
  FOR helper IN VALUES
    ('generations', 'relation text, tile integer, generation bigint', '@extschema@', 'algebra3d_shard_generations'),
    ('statements', 'statement text', '@extschema@', 'algebra3d_shard_statements'),
    ('extensions', 'extname name, extversion text', 'pg_catalog', 'pg_extension'),
    ('tables', 'schema_name name, table_name name, checks text[], is_indexed boolean, generated text[]', '@extschema@', 'algebra3d_shard_tables') LOOP
    EXECUTE format('CREATE FOREIGN TABLE IF NOT EXISTS %I (%s) SERVER %I OPTIONS (schema_name %L, table_name %L)',
      'algebra3d_' || helper.column1 || '_' || server, helper.column2, server, helper.column3, helper.column4);
  END LOOP;
END $$;

-- How many threads a call may use on a server, from its next connection on.
CREATE FUNCTION algebra3d_shard_set_threads(server name, threads integer) RETURNS void LANGUAGE plpgsql VOLATILE
SET search_path = @extschema@, pg_temp AS $$
DECLARE
  before text := (SELECT o.option_value FROM pg_foreign_server s, pg_options_to_table(s.srvoptions) o WHERE s.srvname = server AND o.option_name = 'options');
BEGIN
  EXECUTE format('ALTER SERVER %I OPTIONS (%s options %L)', server, CASE WHEN before IS NULL THEN 'ADD' ELSE 'SET' END,
    ltrim(regexp_replace(coalesce(before, ''), '\s*-c *algebra3d\.threads=\d+', '', 'g') || ' -c algebra3d.threads=' || threads));
END $$;

-- Runs a statement on a server, in the present transaction.
CREATE FUNCTION algebra3d_shard_execute(server name, statement text) RETURNS void LANGUAGE plpgsql VOLATILE
SET search_path = @extschema@, pg_temp SET client_min_messages = warning AS $$
BEGIN
  EXECUTE format('INSERT INTO %I VALUES ($1)', 'algebra3d_statements_' || server) USING statement;
END $$;

-- The columns of a table, "name" type [NOT NULL], but for those that are generated.
CREATE FUNCTION algebra3d_shard_columns(source regclass) RETURNS TABLE (name name, definition text, type text) LANGUAGE SQL STABLE
SET search_path = pg_catalog, pg_temp AS $$
  SELECT attname, pg_catalog.format('%I %s', attname, pg_catalog.format_type(atttypid, atttypmod)) ||
           CASE WHEN attnotnull THEN ' NOT NULL' ELSE '' END,
         (SELECT t.typname::text FROM pg_catalog.pg_type t WHERE t.oid = atttypid AND t.typnamespace = '@extschema@'::regnamespace)
  FROM pg_catalog.pg_attribute WHERE attrelid = source AND attnum > 0 AND NOT attisdropped AND attgenerated = '' ORDER BY attnum
$$;

-- The columns of a tile that the extension adds.
CREATE FUNCTION algebra3d_shard_added_columns(geometry name, type text) RETURNS text LANGUAGE SQL IMMUTABLE RETURN
  format('row_id bigint NOT NULL, tile integer NOT NULL, home boolean NOT NULL, born bigint NOT NULL, died bigint, stamp bigint NOT NULL, '
         'box @extschema@.rect3 GENERATED ALWAYS AS (CASE WHEN %1$I IS NULL THEN NULL WHEN NOT @extschema@.is_empty(%1$I) THEN @extschema@.bbox(%1$I) END) STORED', geometry) ||
  CASE WHEN type IN ('volume3d', 'surface3d', 'points3d', 'mesh3d') THEN
    format(', size bigint GENERATED ALWAYS AS (@extschema@.size(%I)) STORED', geometry) ELSE '' END ||
  CASE WHEN type = 'volume3d' THEN format(', volume float8 GENERATED ALWAYS AS (@extschema@.volume(%I)) STORED', geometry) ELSE '' END ||
  CASE WHEN type IN ('volume3d', 'surface3d') THEN format(', area float8 GENERATED ALWAYS AS (@extschema@.area(%I)) STORED', geometry) ELSE '' END;

-- The table of a tile on its server. Those of each division have names of their own, since the old ones count until a new
-- division is committed here.
CREATE FUNCTION algebra3d_shard_tile_name(known algebra3d_shard_relations, tile integer) RETURNS text LANGUAGE SQL IMMUTABLE
RETURN known.name || coalesce('_v' || substring(known.relation from ' \((\d+)\)$'), '') || '_' || tile;

-- What makes a tile on its server.
CREATE FUNCTION algebra3d_shard_tile_script(known algebra3d_shard_relations, tile integer, definitions text) RETURNS text LANGUAGE SQL STABLE
RETURN pg_catalog.format('CREATE SCHEMA IF NOT EXISTS %1$I; SELECT @extschema@.algebra3d_shard_drop_tile(%1$L, %2$L); '
  'CREATE TABLE %1$I.%2$I (%4$s, CHECK (tile = %3$s), PRIMARY KEY (row_id, stamp)); CREATE INDEX ON %1$I.%2$I USING gist (%5$I); '
  'DELETE FROM @extschema@.algebra3d_shard_generations WHERE relation = %6$L AND tile = %3$s; '
  'INSERT INTO @extschema@.algebra3d_shard_generations VALUES (%6$L, %3$s, 0)',
  known.schema_name, @extschema@.algebra3d_shard_tile_name(known, tile), tile, definitions, known.geometry, known.relation);

-- The k nearest rows of a relation, whose row type the first argument has: of its own tile to bound the distance, then of
-- each tile within that the k nearest. Foreign tables are named themselves: LIMIT is not sent for the one part of another.
CREATE FUNCTION algebra3d_shard_near(row_type anyelement, relation text, place point3d, k integer) RETURNS SETOF anyelement LANGUAGE plpgsql VOLATILE
SET search_path = @extschema@, pg_temp AS $$
DECLARE
  known algebra3d_shard_relations := algebra3d_shard_known(relation);
  columns text := (SELECT string_agg(format('%I', c), ', ') FROM unnest(known.columns) c) || ', row_id';
  radius float8;
  box rect3;
  tiles integer[] := ARRAY(SELECT generate_series(0, tile_count(known.grid) - 1));
BEGIN
  IF k IS NULL OR k < 1 OR place IS NULL THEN
    RETURN;
  END IF;
  PERFORM algebra3d_shard_ready(known.relation, ARRAY[tile_of(place, known.grid)]);
  EXECUTE format('SELECT max(d) FROM (SELECT %1$I <-> $1 AS d FROM %2$I.%3$I WHERE died IS NULL AND tile = ANY (tiles_of(box, %5$L::grid)) '
                 'ORDER BY %1$I <-> $1 LIMIT %4$s) q HAVING count(*) = %4$s', known.geometry, known.schema_name, known.name || '_' || tile_of(place, known.grid), k, known.grid)
    INTO radius USING place;
  IF radius IS NOT NULL THEN
    -- More than the distance was rounded by.
    radius := radius * (1 + 1e-12) + 1e-300;
    box := enlarge_rect(bbox(place), radius, radius, radius);
    tiles := tiles_of(box, known.grid);
  END IF;
  PERFORM algebra3d_shard_ready(known.relation, tiles);
  RETURN QUERY EXECUTE format('SELECT * FROM (%s) q ORDER BY %I <-> $1, row_id LIMIT %s', (SELECT string_agg(format('(SELECT %1$s FROM %2$I.%3$I WHERE died IS NULL AND box IS NOT NULL AND '
      'CASE WHEN $2 IS NULL THEN home ELSE is_pair_tile(tile, box, $2, %4$L::grid) END ORDER BY %5$I <-> $1, row_id LIMIT %6$s)',
      columns, known.schema_name, known.name || '_' || tile, known.grid, known.geometry, k), ' UNION ALL ') FROM unnest(tiles) tile), known.geometry, k) USING place, box;
END $$;

-- How many values' boxes meet a box. Tiles are left out when a plan is made, so it is made for each box: above partitions that are
-- aggregated each for itself, PostgreSQL leaves none out later.
CREATE FUNCTION algebra3d_shard_count(relation text, box rect3) RETURNS bigint LANGUAGE plpgsql VOLATILE
SET search_path = @extschema@, pg_temp AS $$
DECLARE
  known algebra3d_shard_relations := algebra3d_shard_known(relation);
  counted bigint;
BEGIN
  EXECUTE format('SELECT coalesce(sum(n), 0)::bigint FROM (SELECT tile, count(*) AS n FROM %1$I.%2$I WHERE tile = ANY ($2) AND died IS NULL AND %3$I && $1 '
                 'AND is_pair_tile(tile, box, $1, %4$L::grid) AND tile > (SELECT algebra3d_shard_ready($3, $2)) GROUP BY tile) q',
                 known.schema_name, known.name || '_tiles', known.geometry, known.grid) INTO counted USING box, tiles_of(box, known.grid), known.relation;
  RETURN counted;
END $$;

-- What there is one of for a relation: the name of its view and function, and how it is computed of each tile and of these.
CREATE FUNCTION algebra3d_shard_totals(known algebra3d_shard_relations) RETURNS TABLE (total text, type text, of_tile text, of_all text) LANGUAGE SQL IMMUTABLE
BEGIN ATOMIC
  SELECT t.total, t.type, format(t.of_tile, known.geometry), t.of_all FROM (VALUES
    ('count', 'bigint', 'count(*)', 'coalesce(sum(part), 0)::bigint', '{volume3d,surface3d,points3d,point3d,mesh3d}'::text[]),
    ('extent', 'rect3', 'extent(box)', 'extent(part)', '{volume3d,surface3d,points3d,point3d,mesh3d}'),
    ('area', 'float8', 'exact_sum_parts(area)', 'coalesce(exact_sum(part), 0)', '{volume3d,surface3d}'),
    ('volume', 'float8', 'exact_sum_parts(volume)', 'coalesce(exact_sum(part), 0)', '{volume3d}'),
    ('union', 'volume3d', 'union_agg(%I)', 'union_agg(part)', '{volume3d}')) t(total, type, of_tile, of_all, types) WHERE known.geometry_type = ANY (t.types);
END;
-- What makes the views of a relation: its rows, and what there is one of, with a function that reads that view.
CREATE FUNCTION algebra3d_shard_view_script(known algebra3d_shard_relations) RETURNS text[] LANGUAGE SQL STABLE
RETURN ARRAY[
  format('CREATE OR REPLACE VIEW %1$I.%2$I WITH (security_invoker = true) AS SELECT %4$s, row_id FROM %1$I.%3$I '
    'WHERE home AND died IS NULL AND tile > (SELECT algebra3d_shard_ready(%5$L))', known.schema_name, known.name, known.name || '_tiles',
    (SELECT string_agg(format('%I', c), ', ') FROM unnest(known.columns) c), known.relation),
  format('CREATE OR REPLACE TRIGGER stamp BEFORE INSERT OR UPDATE OR DELETE ON %1$I.%2$I FOR EACH STATEMENT EXECUTE FUNCTION algebra3d_shard_stamp(%3$L)',
    known.schema_name, known.name, format('%I.%I', known.schema_name, known.name || '_row_id')),
  format('CREATE OR REPLACE TRIGGER write INSTEAD OF INSERT OR UPDATE OR DELETE ON %1$I.%2$I FOR EACH ROW EXECUTE FUNCTION algebra3d_shard_write()',
    known.schema_name, known.name)] ||
  ARRAY(SELECT format(made, known.schema_name, known.name || '_' || t.total, known.name || '_tiles', t.of_all, t.total, t.of_tile, known.relation, t.type)
    FROM algebra3d_shard_totals(known) t, unnest(ARRAY[
      'CREATE OR REPLACE VIEW %1$I.%2$I WITH (security_invoker = true) AS SELECT %4$s AS %5$I FROM (SELECT tile, %6$s AS part FROM %1$I.%3$I '
      'WHERE home AND died IS NULL AND tile > (SELECT algebra3d_shard_ready(%7$L)) GROUP BY tile) q',
      'CREATE OR REPLACE FUNCTION %1$I.%2$I() RETURNS %8$s LANGUAGE SQL STABLE PARALLEL RESTRICTED BEGIN ATOMIC SELECT %5$I FROM %1$I.%2$I; END'])
      WITH ORDINALITY n(made, i) ORDER BY t.total, i);

-- What makes the functions of a relation, which know its grid; they are used by statements that are planned while it is another,
-- so they do not ask which copy is at home.
CREATE FUNCTION algebra3d_shard_functions_script(known algebra3d_shard_relations) RETURNS text[] LANGUAGE plpgsql STABLE AS $$
DECLARE
  statement text;
  made text[] := '{}';
BEGIN
  FOREACH statement IN ARRAY ARRAY[
    'CREATE OR REPLACE FUNCTION %1$I.%7$I(box rect3) RETURNS SETOF %1$I.%2$I LANGUAGE SQL STABLE PARALLEL RESTRICTED BEGIN ATOMIC '
    'SELECT %4$s, row_id FROM %1$I.%3$I WHERE tile = ANY (tiles_of($1, %5$L::grid)) AND died IS NULL AND %3$I.%6$I && $1 '
    'AND is_pair_tile(tile, %3$I.box, $1, %5$L::grid) AND tile > (SELECT algebra3d_shard_ready(%10$L, tiles_of($1, %5$L::grid), %11$s)); END',
    'CREATE OR REPLACE FUNCTION %1$I.%8$I(box rect3) RETURNS bigint LANGUAGE SQL VOLATILE BEGIN ATOMIC SELECT algebra3d_shard_count(%10$L, $1); END',
    'CREATE OR REPLACE FUNCTION %1$I.%9$I(place point3d, k integer) RETURNS SETOF %1$I.%2$I LANGUAGE SQL VOLATILE BEGIN ATOMIC '
    'SELECT n.* FROM algebra3d_shard_near(NULL::%1$I.%2$I, %10$L, $1, $2) n; END']
  LOOP
    made := made || format(statement, known.schema_name, known.name, known.name || '_tiles',
      (SELECT string_agg(format('%I', c), ', ') FROM unnest(known.columns) c), known.grid, known.geometry,
      known.name || '_window', known.name || '_count', known.name || '_near', known.relation, @extschema@.tile_count(known.grid));
  END LOOP;
  RETURN made;
END $$;

-- Runs statements in turn. Names without a schema are those of the extension.
CREATE FUNCTION algebra3d_shard_run_all(statements text[]) RETURNS void LANGUAGE plpgsql VOLATILE
SET search_path = @extschema@, pg_temp SET client_min_messages = warning AS $$
DECLARE
  statement text;
BEGIN
  FOREACH statement IN ARRAY statements LOOP
    EXECUTE statement;
  END LOOP;
END $$;

-- What makes a tile here: a foreign table, as a partition of `parent` if there is one. `bytes`: of a value; some 8 MB of rows travel at a time.
CREATE FUNCTION algebra3d_shard_foreign_table_script(known algebra3d_shard_relations, tile integer, server name, name text, kind text, bytes float8) RETURNS text
LANGUAGE SQL STABLE
RETURN format('CREATE FOREIGN TABLE %1$I.%2$I %3$s SERVER %4$I OPTIONS (schema_name %1$L, table_name %5$L, fetch_size ''%6$s'', batch_size ''%6$s'')',
  known.schema_name, name, kind, server, @extschema@.algebra3d_shard_tile_name(known, tile),
  greatest(10, least(10000, 8e6 / greatest(coalesce(bytes, 4000), 100)))::integer);

-- What makes the tiles of a relation, here and on their servers: PREFIX_tiles, and PREFIX_0 ... as its partitions.
CREATE FUNCTION algebra3d_shard_tiles_script(known algebra3d_shard_relations, servers text[], definitions text, bytes float8, prefix text) RETURNS text[]
LANGUAGE plpgsql STABLE SET search_path = @extschema@, pg_temp AS $$
DECLARE
  made text[];
  places text[];
BEGIN
  IF cardinality(servers) IS NULL OR cardinality(servers) = 0 OR array_position(servers, NULL) IS NOT NULL THEN
    RAISE 'no servers, expected at least one' USING ERRCODE = 'invalid_parameter_value';
  END IF;
  -- Tiles of one number lie on one server in all relations of a grid: what was decided for the first one holds.
  places := ARRAY(SELECT coalesce((SELECT t.server FROM algebra3d_shard_tiles t JOIN algebra3d_shard_relations r USING (relation)
      WHERE (r.schema_name, r.name) <> (known.schema_name, known.name) AND r.grid::text = known.grid::text AND t.tile = i ORDER BY r.relation LIMIT 1),
    servers[i % cardinality(servers) + 1]) FROM generate_series(0, tile_count(known.grid) - 1) i ORDER BY i);
  made := ARRAY[
    format('INSERT INTO algebra3d_shard_relations (relation, schema_name, name, geometry, geometry_type, columns, grid, reach) VALUES (%L, %L, %L, %L, %L, %L, %L, %L)',
      known.relation, known.schema_name, known.name, known.geometry, known.geometry_type, known.columns, known.grid, known.reach),
    format('INSERT INTO algebra3d_shard_tiles (relation, tile, server) VALUES %s',
      (SELECT string_agg(format('(%L, %s, %L)', known.relation, n - 1, place), ', ' ORDER BY n) FROM unnest(places) WITH ORDINALITY p(place, n))),
    format('CREATE TABLE %I.%I (%s) PARTITION BY LIST (tile)', known.schema_name, prefix || '_tiles', definitions)];
  made := made || ARRAY(SELECT DISTINCT format('SELECT algebra3d_shard_server(%L)', place) FROM unnest(places) place ORDER BY 1);
  FOR i IN 0 .. tile_count(known.grid) - 1 LOOP
    made := made || format('SELECT algebra3d_shard_execute(%L, %L)', places[i + 1], algebra3d_shard_tile_script(known, i, definitions)) ||
      algebra3d_shard_foreign_table_script(known, i, places[i + 1], prefix || '_' || i,
        format('PARTITION OF %I.%I FOR VALUES IN (%s)', known.schema_name, prefix || '_tiles', i), bytes);
  END LOOP;
  RETURN made;
END $$;

-- What divides a table, but for loading its rows; and its relation.
CREATE FUNCTION algebra3d_shard_set_up(relation text, grid grid, servers text[], reach float8, threads integer, OUT known algebra3d_shard_relations, OUT statements text[])
LANGUAGE plpgsql STABLE SET search_path = @extschema@, pg_temp AS $$
DECLARE
  source regclass;
  definitions text;
  bytes float8;
  taken name;
BEGIN
  SELECT c.oid::regclass, n.nspname, c.relname INTO source, known.schema_name, known.name
    FROM pg_class c JOIN pg_namespace n ON n.oid = c.relnamespace WHERE c.oid = to_regclass(
      CASE WHEN cardinality(parse_ident(relation)) = 1 THEN format('%I.%s', coalesce(
        (SELECT n.nspname FROM pg_class c JOIN pg_namespace n ON n.oid = c.relnamespace WHERE c.relname = (parse_ident(relation))[1]
         AND c.relkind = 'r' AND n.nspname !~ '^pg_' ORDER BY n.nspname = 'public' DESC LIMIT 1), 'public'), relation) ELSE relation END)
      AND c.relkind = 'r';
  IF source IS NULL THEN
    RAISE 'no table %, whose columns and rows the tiles are to have', relation USING ERRCODE = 'undefined_table';
  END IF;
  IF NOT (reach >= 0 AND reach < 'infinity') THEN
    RAISE 'a reach of %, expected a distance from 0', reach USING ERRCODE = 'invalid_parameter_value';
  END IF;
  IF threads < 1 THEN
    RAISE '% threads, expected at least 1', threads USING ERRCODE = 'invalid_parameter_value';
  END IF;
  known.relation := format('%I.%I', known.schema_name, known.name);
  known.grid := grid;
  known.reach := reach;
  SELECT c.name, c.type INTO known.geometry, known.geometry_type FROM algebra3d_shard_columns(source) c
    WHERE c.type IN ('volume3d', 'surface3d', 'points3d', 'point3d', 'mesh3d') LIMIT 1;
  IF NOT FOUND THEN
    RAISE 'table % has no column of a type in space', known.relation USING ERRCODE = 'datatype_mismatch';
  END IF;
  SELECT array_agg(c.name), string_agg(c.definition, ', ') INTO known.columns, definitions FROM algebra3d_shard_columns(source) c;
  SELECT c INTO taken FROM unnest(known.columns) c WHERE c IN ('row_id', 'tile', 'home', 'born', 'died', 'stamp', 'box', 'size', 'volume', 'area') LIMIT 1;
  IF FOUND THEN
    RAISE 'column % of % has a name that tiles need', taken, known.relation USING ERRCODE = 'duplicate_column',
      HINT = 'row_id, tile, home, born, died, stamp, box, size, volume and area are added to each tile.';
  END IF;
  definitions := definitions || ', ' || algebra3d_shard_added_columns(known.geometry, known.geometry_type);
  EXECUTE format('SELECT avg(pg_column_size(%I)) FROM (SELECT %1$I FROM %s LIMIT 1000) q', known.geometry, source) INTO bytes;
  statements := ARRAY[
      format('ALTER TABLE %I.%I RENAME TO %I', known.schema_name, known.name, known.name || '_local'),
      format('CREATE SEQUENCE %I.%I', known.schema_name, known.name || '_row_id')] ||
    algebra3d_shard_tiles_script(known, servers, definitions, bytes, known.name) ||
    ARRAY(SELECT DISTINCT format('SELECT algebra3d_shard_set_threads(%L, %s)', server, threads) FROM unnest(servers) server WHERE threads IS NOT NULL ORDER BY 1) ||
    algebra3d_shard_view_script(known) || algebra3d_shard_functions_script(known) ||
    ARRAY[format('ALTER DATABASE %I SET enable_partitionwise_join = on', current_database()),
      format('ALTER DATABASE %I SET enable_partitionwise_aggregate = on', current_database())];
END $$;

CREATE FUNCTION algebra3d_shard_create(relation text, grid grid, servers text[], reach float8 DEFAULT 0, threads integer DEFAULT NULL) RETURNS bigint LANGUAGE plpgsql VOLATILE
SET search_path = @extschema@, pg_temp AS $$
DECLARE
  set_up record;
BEGIN
  SELECT * INTO set_up FROM algebra3d_shard_set_up(relation, grid, servers, reach, threads);
  PERFORM algebra3d_shard_run_all(set_up.statements);
  RETURN algebra3d_shard_load((set_up.known).relation, format('%I.%I', (set_up.known).schema_name, (set_up.known).name || '_local')::regclass);
END $$;
COMMENT ON FUNCTION algebra3d_shard_create(text, grid, text[], float8, integer) IS 'Divides a table into the tiles of a grid, on servers of postgres_fdw in turns, and loads its rows; the number of rows. The table itself becomes R_local, and R a view over the tiles. reach: the greatest distance of a distance join; threads: of a call on each server, NULL: as set there.';

CREATE FUNCTION algebra3d_shard_script(relation text, grid grid, servers text[], reach float8 DEFAULT 0, threads integer DEFAULT NULL) RETURNS SETOF text LANGUAGE SQL STABLE
BEGIN ATOMIC
  SELECT line || ';' FROM algebra3d_shard_set_up(relation, grid, servers, reach, threads) s, unnest(
    '{BEGIN,SET LOCAL search_path = @extschema@,SET LOCAL client_min_messages = warning}'::text[] || s.statements ||
    ARRAY[format('SELECT algebra3d_shard_load(%L, %L)', (s.known).relation, format('%I.%I', (s.known).schema_name, (s.known).name || '_local')), 'COMMIT'])
    WITH ORDINALITY n(line, place) ORDER BY place;
END;
COMMENT ON FUNCTION algebra3d_shard_script(text, grid, text[], float8, integer) IS 'The statements that algebra3d_shard_create runs, a line each.';

-- -1, or an error for a distance for which the copies do not reach.
CREATE FUNCTION algebra3d_shard_within_reach(distance float8, reach float8) RETURNS integer LANGUAGE plpgsql IMMUTABLE AS $$
BEGIN
  IF distance > reach THEN
    RAISE 'a distance of %, but the relations were divided for distances of at most %', distance, reach
      USING ERRCODE = 'invalid_parameter_value', HINT = 'The last argument of algebra3d_shard_create is that limit.';
  END IF;
  RETURN -1;
END $$;

-- Joins of two relations of one grid.
CREATE FUNCTION algebra3d_shard_join(a text, b text) RETURNS void LANGUAGE plpgsql VOLATILE
SET search_path = @extschema@, pg_temp AS $$
DECLARE
  first algebra3d_shard_relations := algebra3d_shard_known(a);
  second algebra3d_shard_relations := algebra3d_shard_known(b);
  name text := first.name || '_' || second.name;
  first_name text := CASE WHEN first.relation = second.relation THEN 'first' ELSE first.name END;
  second_name text := CASE WHEN first.relation = second.relation THEN 'second' ELSE second.name END;
  joined text;
  columns text;
  statement text;
BEGIN
  IF first.grid::text <> second.grid::text THEN
    RAISE 'relations % and % have different grids', first.relation, second.relation USING ERRCODE = 'object_not_in_prerequisite_state',
      HINT = 'Only tiles of one grid are joined on their server: divide one of them anew with the grid of the other.';
  END IF;
  joined := format('%1$I.%2$I a JOIN %3$I.%4$I b ON a.tile = b.tile AND a.died IS NULL AND b.died IS NULL '
                 'AND a.tile > (SELECT algebra3d_shard_ready(%5$L, NULL, %7$s)) AND b.tile > (SELECT algebra3d_shard_ready(%6$L, NULL, %7$s))',
                 first.schema_name, first.name || '_tiles', second.schema_name, second.name || '_tiles', first.relation, second.relation, tile_count(first.grid));
  columns := (SELECT string_agg(format('a.%I AS %I', c, first_name || '_' || c), ', ') FROM unnest(first.columns || name 'row_id') c) || ', ' ||
             (SELECT string_agg(format('b.%I AS %I', c, second_name || '_' || c), ', ') FROM unnest(second.columns || name 'row_id') c);
  FOREACH statement IN ARRAY ARRAY[
    'CREATE OR REPLACE VIEW %1$I.%2$I WITH (security_invoker = true) AS SELECT %5$s FROM %6$s AND is_pair_tile(a.tile, a.box, b.box, %9$L::grid) '
    'AND intersects(a.%7$I, b.%8$I)',
    'CREATE OR REPLACE VIEW %1$I.%3$I WITH (security_invoker = true) AS SELECT coalesce(sum(n), 0)::bigint AS count FROM (SELECT a.tile, count(*) AS n FROM %6$s '
    'AND is_pair_tile(a.tile, a.box, b.box, %9$L::grid) AND intersects(a.%7$I, b.%8$I) GROUP BY a.tile) q',
    'CREATE OR REPLACE FUNCTION %1$I.%4$I(distance float8) RETURNS SETOF %1$I.%2$I LANGUAGE SQL STABLE PARALLEL RESTRICTED BEGIN ATOMIC '
    'SELECT %5$s FROM %6$s AND within_distance(a.%7$I, b.%8$I, $1) AND is_pair_tile(a.tile, a.box, b.box, %9$L::grid, %10$L::float8) '
    'AND a.tile > algebra3d_shard_within_reach($1, %10$L::float8); END'] LOOP
    EXECUTE format(statement, first.schema_name, name || '_pairs', name || '_count', name || '_within', columns, joined,
                   first.geometry, second.geometry, first.grid, least(first.reach, second.reach));
  END LOOP;
  INSERT INTO algebra3d_shard_joins VALUES (first.relation, second.relation) ON CONFLICT DO NOTHING;
END $$;
COMMENT ON FUNCTION algebra3d_shard_join(text, text) IS 'Makes the views A_B_pairs and A_B_count of the pairs that intersect, and the function A_B_within(distance).';

---- Keeping ----

CREATE FUNCTION algebra3d_shard_grant(relation text, role name, writes boolean DEFAULT false) RETURNS void LANGUAGE plpgsql VOLATILE
SET search_path = @extschema@, pg_temp AS $$
DECLARE
  known algebra3d_shard_relations := algebra3d_shard_relation(relation);
  rights text := CASE WHEN writes THEN 'SELECT, INSERT, UPDATE, DELETE' ELSE 'SELECT' END;
  one record;
BEGIN
  EXECUTE format('GRANT %s ON %I.%I, %2$I.%4$I TO %5$I', rights, known.schema_name, known.name, known.name || '_tiles', role);
  PERFORM algebra3d_shard_run_all(ARRAY(SELECT format('GRANT SELECT ON %I.%I TO %I', known.schema_name, known.name || '_' || t.total, role)
    FROM algebra3d_shard_totals(known) t));
  FOR one IN SELECT t.tile, t.server FROM algebra3d_shard_tiles t WHERE t.relation = known.relation LOOP
    EXECUTE format('GRANT %s ON %I.%I TO %I', rights, known.schema_name, known.name || '_' || one.tile, role);
    EXECUTE format('GRANT %s ON %s TO %I', CASE WHEN writes THEN 'SELECT, UPDATE' ELSE 'SELECT' END, algebra3d_shard_generations_of(one.server), role);
  END LOOP;
  IF writes THEN
    EXECUTE format('GRANT UPDATE ON algebra3d_shard_tiles TO %I', role);
    EXECUTE format('GRANT USAGE ON SEQUENCE %I.%I TO %I', known.schema_name, known.name || '_row_id', role);
  END IF;
END $$;
-- What algebra3d_shard_grant gave, for tiles that are new.
CREATE FUNCTION algebra3d_shard_grant_again(relation text) RETURNS void LANGUAGE plpgsql VOLATILE
SET search_path = @extschema@, pg_temp AS $$
DECLARE
  known algebra3d_shard_relations := algebra3d_shard_relation(relation);
BEGIN
  PERFORM algebra3d_shard_grant(known.relation, pg_get_userbyid(g.grantee), g.writes) FROM (
    SELECT a.grantee, bool_or(a.privilege_type = 'INSERT') AS writes FROM pg_class c, aclexplode(c.relacl) a
    WHERE c.oid = format('%I.%I', known.schema_name, known.name)::regclass AND a.grantee NOT IN (0, c.relowner) GROUP BY 1) g;
END $$;
COMMENT ON FUNCTION algebra3d_shard_grant(text, name, boolean) IS 'Lets a role read a relation over several servers here, or write it, too; on the servers the rights are those of its user mapping.';

CREATE FUNCTION algebra3d_shard_repair() RETURNS TABLE (relation text, tile integer, remedy text) LANGUAGE plpgsql VOLATILE AS $$
DECLARE
  known @extschema@.algebra3d_shard_relations;
  parent text;
  other record;
  server_name name;
BEGIN
  FOR known IN SELECT r.* FROM @extschema@.algebra3d_shard_relations r ORDER BY r.relation LOOP
    -- Transactions that write end first.
    PERFORM FROM @extschema@.algebra3d_shard_tiles t WHERE t.relation = known.relation ORDER BY t.tile FOR UPDATE;
    parent := format('%I.%I', known.schema_name, known.name || '_tiles');
    FOR other IN SELECT d.* FROM @extschema@.algebra3d_shard_differences(known.relation) d LOOP
      relation := known.relation;
      tile := other.tile;
      IF other.there IS NULL OR other.there < other.here THEN
        remedy := format('none: it is at generation %s, %s is known here; restore its server from a newer backup', coalesce(other.there, 0), other.here);
        RETURN NEXT;
        CONTINUE;
      END IF;
      -- What died in a generation goes with the next but one.
      IF other.there > other.here + 1 THEN
        remedy := format('none: it is at generation %s, %s is known here; restore the coordinator from a newer backup', other.there, other.here);
        RETURN NEXT;
        CONTINUE;
      END IF;
      EXECUTE format('UPDATE %s SET died = NULL WHERE tile = $1 AND died > $2', parent) USING other.tile, other.here;
      EXECUTE format('DELETE FROM %s WHERE tile = $1 AND born > $2', parent) USING other.tile, other.here;
      SELECT t.server INTO server_name FROM @extschema@.algebra3d_shard_tiles t WHERE t.relation = known.relation AND t.tile = other.tile;
      EXECUTE format('UPDATE %s SET generation = $3 WHERE relation = $1 AND tile = $2', @extschema@.algebra3d_shard_generations_of(server_name))
        USING known.relation, other.tile, other.here;
      remedy := format('taken back from generation %s to %s, which was committed', other.there, other.here);
      RETURN NEXT;
    END LOOP;
  END LOOP;
END $$;
COMMENT ON FUNCTION algebra3d_shard_repair() IS 'Takes back on each server what a transaction wrote that was not committed here, and says of which tiles.';

-- Locks tables, and views, against all others, who wait for the locks as long as those do who read now: so for half a second at most, and all or none.
CREATE FUNCTION algebra3d_shard_lock(tables text[], views text[]) RETURNS void LANGUAGE plpgsql VOLATILE AS $$
DECLARE
  statement text;
  ends timestamptz;
BEGIN
  FOR attempt IN 1 .. 100 LOOP
    BEGIN
      ends := pg_catalog.clock_timestamp() + interval '0.5 s';
      -- Views first, as readers do. LOCK would lock what they read, too, and wait for each.
      FOREACH statement IN ARRAY ARRAY(SELECT format('ALTER VIEW %s SET (security_invoker = true)', v) FROM unnest(views) v) ||
                                 ARRAY(SELECT format('LOCK TABLE ONLY %s IN ACCESS EXCLUSIVE MODE', t) FROM unnest(tables) t) LOOP
        PERFORM pg_catalog.set_config('lock_timeout', greatest(1000 * extract(epoch FROM ends - pg_catalog.clock_timestamp()), 1)::integer || 'ms', true);
        EXECUTE statement;
      END LOOP;
      PERFORM pg_catalog.set_config('lock_timeout', '0', true);
      RETURN;
    EXCEPTION WHEN lock_not_available THEN
      PERFORM pg_catalog.pg_sleep(0.5);
    END;
  END LOOP;
  RAISE '% was not locked: others read all the time', pg_catalog.array_to_string(views || tables, ', ') USING ERRCODE = 'lock_not_available',
    HINT = 'What was begun is undone. See pg_stat_activity for transactions that stay open.';
END $$;

-- Moves a tile to another server: its rows are copied while others read, then the partition is exchanged.
CREATE PROCEDURE algebra3d_shard_move(relation text, tile integer, server name) LANGUAGE plpgsql AS $$
DECLARE
  known @extschema@.algebra3d_shard_relations := @extschema@.algebra3d_shard_relation(relation);
  before name := (SELECT t.server FROM @extschema@.algebra3d_shard_tiles t WHERE t.relation = known.relation AND t.tile = $2);
  foreign_name text := known.name || '_' || tile;
  parent text := format('%I.%I', known.schema_name, known.name || '_tiles');
  definitions text;
  columns text := (SELECT string_agg(format('%I', c), ', ') FROM unnest(known.columns || '{row_id,tile,home,born,died,stamp}'::name[]) c);
  options text;
  is_elsewhere boolean;
BEGIN
  IF before IS NULL THEN
    RAISE '% has no tile %', known.relation, tile USING ERRCODE = 'invalid_parameter_value';
  END IF;
  IF before = server THEN
    RETURN;
  END IF;
  SELECT string_agg(format('%I %L', option_name, option_value), ', ') INTO options FROM pg_catalog.pg_foreign_table f,
    pg_catalog.pg_options_to_table(f.ftoptions) WHERE f.ftrelid = format('%I.%I', known.schema_name, foreign_name)::regclass;
  PERFORM pg_catalog.pg_advisory_xact_lock(pg_catalog.hashtext('algebra3d ' || known.relation), tile);
  PERFORM @extschema@.algebra3d_shard_ready(known.relation, ARRAY[tile]);
  PERFORM @extschema@.algebra3d_shard_server(server);
  SELECT string_agg(c.definition, ', ') || ', ' || @extschema@.algebra3d_shard_added_columns(known.geometry, known.geometry_type) INTO definitions
    FROM @extschema@.algebra3d_shard_columns(parent::regclass) c WHERE c.name = ANY (known.columns);
  EXECUTE format('CREATE FOREIGN TABLE %I.%I (%s) SERVER %I OPTIONS (%s)', known.schema_name, foreign_name || '_moving', definitions, server, options);
  -- Foreign servers may name one database, where the table stays.
  is_elsewhere := (SELECT count(DISTINCT @extschema@.algebra3d_shard_address(s.srvoptions)) > 1 FROM pg_catalog.pg_foreign_server s WHERE s.srvname IN (before, server));
  IF is_elsewhere THEN
    -- Begins to read there: the tile that is read is not taken for one that was left behind, if its server has two names.
    EXECUTE format('SELECT FROM %I.%I LIMIT 1', known.schema_name, foreign_name);
    PERFORM @extschema@.algebra3d_shard_execute(server, @extschema@.algebra3d_shard_tile_script(known, tile, definitions));
    EXECUTE format('INSERT INTO %1$I.%2$I (%4$s) SELECT %4$s FROM %1$I.%3$I', known.schema_name, foreign_name || '_moving', foreign_name, columns);
    EXECUTE format('UPDATE %s SET generation = (SELECT t.generation FROM @extschema@.algebra3d_shard_tiles t WHERE t.relation = $1 AND t.tile = $2) '
                   'WHERE relation = $1 AND tile = $2', @extschema@.algebra3d_shard_generations_of(server)) USING known.relation, tile;
  END IF;
  UPDATE @extschema@.algebra3d_shard_tiles t SET server = $3, writer = pg_catalog.pg_current_xact_id(), writer_before = t.writer WHERE t.relation = known.relation AND t.tile = $2;
  PERFORM @extschema@.algebra3d_shard_lock(ARRAY[parent], '{}');
  EXECUTE format('DROP FOREIGN TABLE %I.%I', known.schema_name, foreign_name);
  EXECUTE format('ALTER FOREIGN TABLE %I.%I RENAME TO %I', known.schema_name, foreign_name || '_moving', foreign_name);
  EXECUTE format('ALTER TABLE %s ATTACH PARTITION %I.%I FOR VALUES IN (%s)', parent, known.schema_name, foreign_name, tile);
  PERFORM @extschema@.algebra3d_shard_grant_again(known.relation);
  COMMIT;
  IF NOT is_elsewhere THEN
    RETURN;
  END IF;
  -- Not before: until then the old tile is the one that counts.
  PERFORM @extschema@.algebra3d_shard_execute(before, format('DROP TABLE %I.%I', known.schema_name, @extschema@.algebra3d_shard_tile_name(known, tile)));
  PERFORM @extschema@.algebra3d_shard_execute(before, format(
    'DELETE FROM @extschema@.algebra3d_shard_generations WHERE relation = %L AND tile = %s', known.relation, tile));
END $$;
COMMENT ON PROCEDURE algebra3d_shard_move(text, integer, name) IS 'Moves a tile to another server; who writes into it meanwhile gets an error, who reads waits a moment at most.';

-- A grid with a tile divided: by the plane across the low corners of its solids that leaves the fewest in the larger part.
CREATE FUNCTION algebra3d_shard_halves(known algebra3d_shard_relations, tile integer) RETURNS grid LANGUAGE plpgsql VOLATILE
SET search_path = @extschema@, pg_temp AS $$
DECLARE
  axis text;
  place float8;
  counted bigint;
  those_at_home text := format('FROM %I.%I WHERE tile = %s AND home AND died IS NULL AND box IS NOT NULL', known.schema_name, known.name || '_tiles', tile);
BEGIN
  EXECUTE 'SELECT coalesce(sum(n), 0) FROM (SELECT tile, count(*) AS n ' || those_at_home || ' GROUP BY tile) q' INTO counted;
  -- Some ten thousand boxes are enough.
  EXECUTE format(
    'WITH sides AS MATERIALIZED (SELECT a.axis, min_d(b.box, a.n) AS low, max_d(b.box, a.n) AS high '
      'FROM (SELECT box %s AND row_id %% %s = 0) b, (VALUES (''x'', 1), (''y'', 2), (''z'', 3)) a(axis, n)), '
    'middles AS (SELECT axis, percentile_disc(0.5) WITHIN GROUP (ORDER BY low) AS middle, min(low) AS least FROM sides GROUP BY axis), '
    'places AS (SELECT axis, min(low) AS place FROM sides JOIN middles USING (axis) WHERE low >= middle AND low > least GROUP BY axis) '
    'SELECT axis, place FROM places JOIN sides USING (axis) GROUP BY axis, place '
    'ORDER BY greatest(count(*) FILTER (WHERE low < place), count(*) FILTER (WHERE high >= place)), axis LIMIT 1', those_at_home, greatest(counted / 10000, 1))
    INTO axis, place;
  IF place IS NULL THEN
    RAISE 'tile % of % cannot be divided: % solids are at home there, and all at one place', tile, known.relation, counted USING ERRCODE = 'invalid_parameter_value';
  END IF;
  RETURN grid(known.grid, tile, axis, place);
END $$;

-- Divides a tile of all relations of a grid. Its rows are copied into a new tile while others read. Statements that were planned for the
-- grid of before read on: the old tile keeps its copies, of which those that are not at home there any more say so. They go when
-- these statements have ended (algebra3d_shard_trim).
CREATE PROCEDURE algebra3d_shard_split(relation text, tile integer, server name DEFAULT NULL) LANGUAGE plpgsql AS $$
DECLARE
  named @extschema@.algebra3d_shard_relations := @extschema@.algebra3d_shard_relation(relation);
  known @extschema@.algebra3d_shard_relations;
  added integer := @extschema@.tile_count(named.grid);
  new_grid @extschema@.grid;
  names text[];
  locked text[];
  views text[];
  place record;
  target name;
  foreign_name text;
  definitions text;
  options text;
  columns text;
  copy text;
BEGIN
  IF NOT coalesce(tile BETWEEN 0 AND added - 1, false) THEN
    RAISE '% has no tile %', named.relation, tile USING ERRCODE = 'invalid_parameter_value';
  END IF;
  SELECT array_agg(r.relation), array_agg(r.parent) INTO names, locked FROM (SELECT r.relation, format('%I.%I', r.schema_name, r.name || '_tiles') AS parent
    FROM @extschema@.algebra3d_shard_relations r WHERE r.grid::text = named.grid::text ORDER BY r.relation FOR NO KEY UPDATE) r;
  IF array_position(names, named.relation) IS NULL THEN
    RAISE 'the grid of % was changed meanwhile', named.relation USING ERRCODE = 'serialization_failure';
  END IF;
  views := ARRAY(SELECT format('%I.%I', a.schema_name, a.name || '_' || b.name || suffix) FROM @extschema@.algebra3d_shard_joins j
    JOIN @extschema@.algebra3d_shard_relations a ON a.relation = j.a JOIN @extschema@.algebra3d_shard_relations b ON b.relation = j.b, unnest('{_pairs,_count}'::text[]) suffix
    WHERE j.a = ANY (names) ORDER BY 1);
  -- Who writes is told so, as by algebra3d_shard_move.
  PERFORM pg_catalog.pg_advisory_xact_lock(pg_catalog.hashtext('algebra3d ' || n), tile) FROM unnest(names) n;
  PERFORM @extschema@.algebra3d_shard_ready(n, ARRAY[tile]) FROM unnest(names) n;
  new_grid := @extschema@.algebra3d_shard_halves(named, tile);
  FOR known IN SELECT r.* FROM @extschema@.algebra3d_shard_relations r WHERE r.relation = ANY (names) ORDER BY r.relation LOOP
    PERFORM @extschema@.algebra3d_shard_begin(known.relation, ARRAY[tile]);
    SELECT t.server, t.generation INTO place FROM @extschema@.algebra3d_shard_tiles t WHERE t.relation = known.relation AND t.tile = $2;
    target := coalesce($3, place.server);
    foreign_name := known.name || '_' || added;
    SELECT string_agg(c.definition, ', ') || ', ' || @extschema@.algebra3d_shard_added_columns(known.geometry, known.geometry_type) INTO definitions
      FROM @extschema@.algebra3d_shard_columns(format('%I.%I', known.schema_name, known.name || '_tiles')::regclass) c WHERE c.name = ANY (known.columns);
    SELECT string_agg(format('%I %L', option_name, CASE option_name WHEN 'table_name' THEN @extschema@.algebra3d_shard_tile_name(known, added) ELSE option_value END), ', ')
      INTO options FROM pg_catalog.pg_foreign_table f, pg_catalog.pg_options_to_table(f.ftoptions)
      WHERE f.ftrelid = format('%I.%I', known.schema_name, known.name || '_' || tile)::regclass;
    PERFORM @extschema@.algebra3d_shard_server(target);
    PERFORM @extschema@.algebra3d_shard_execute(target, @extschema@.algebra3d_shard_tile_script(known, added, definitions));
    EXECUTE format('CREATE FOREIGN TABLE %I.%I (%s) SERVER %I OPTIONS (%s)', known.schema_name, foreign_name, definitions, target, options);
    INSERT INTO @extschema@.algebra3d_shard_tiles (relation, tile, server, writer) VALUES (known.relation, added, target, pg_catalog.pg_current_xact_id());
    columns := (SELECT string_agg(format('%I', c), ', ') FROM unnest(known.columns) c);
    copy := format('INSERT INTO %1$I.%%I (%2$s, row_id, tile, home, born, stamp) SELECT %2$s, row_id, %3$s, home AND @extschema@.tile_of(box, %4$L::@extschema@.grid) = %3$s, 0, stamp '
      'FROM %1$I.%%I WHERE died IS NULL AND %3$s = ANY (@extschema@.tiles_of(box, %4$L::@extschema@.grid, %5$L::float8))',
      known.schema_name, columns, added, new_grid, known.reach);
    IF target = place.server THEN
      PERFORM @extschema@.algebra3d_shard_execute(target, format(copy, @extschema@.algebra3d_shard_tile_name(known, added), @extschema@.algebra3d_shard_tile_name(known, tile)));
    ELSE
      EXECUTE format(copy, foreign_name, known.name || '_' || tile);
    END IF;
    PERFORM @extschema@.algebra3d_shard_execute(place.server, s) FROM unnest(ARRAY[
      'UPDATE %1$I.%2$I SET died = %4$s WHERE died IS NULL AND home AND @extschema@.tile_of(box, %5$L::@extschema@.grid) = %6$s',
      'INSERT INTO %1$I.%2$I (%3$s, row_id, tile, home, born, stamp) SELECT %3$s, row_id, tile, false, %4$s, %7$s FROM %1$I.%2$I WHERE died = %4$s',
      'ANALYZE %1$I.%2$I']) WITH ORDINALITY n(statement, i), format(statement, known.schema_name, @extschema@.algebra3d_shard_tile_name(known, tile), columns, place.generation, new_grid, added,
        nextval(format('%I.%I', known.schema_name, known.name || '_row_id')::regclass)) s ORDER BY i;
    PERFORM @extschema@.algebra3d_shard_execute(target, format('ANALYZE %I.%I', known.schema_name, @extschema@.algebra3d_shard_tile_name(known, added)));
  END LOOP;

  PERFORM @extschema@.algebra3d_shard_lock(locked, views);
  FOR known IN UPDATE @extschema@.algebra3d_shard_relations r SET grid = new_grid, split_tiles = r.split_tiles || $2 WHERE r.relation = ANY (names) RETURNING r.* LOOP
    EXECUTE format('ALTER TABLE %1$I.%2$I ATTACH PARTITION %1$I.%3$I FOR VALUES IN (%4$s)', known.schema_name, known.name || '_tiles', known.name || '_' || added, added);
    PERFORM @extschema@.algebra3d_shard_run_all(@extschema@.algebra3d_shard_functions_script(known));
    PERFORM @extschema@.algebra3d_shard_grant_again(known.relation);
  END LOOP;
  PERFORM @extschema@.algebra3d_shard_join(j.a, j.b) FROM @extschema@.algebra3d_shard_joins j WHERE j.a = ANY (names);
  COMMIT;
  CALL @extschema@.algebra3d_shard_trim(named.relation);
END $$;
COMMENT ON PROCEDURE algebra3d_shard_split(text, integer, name) IS 'Divides a tile of all relations of a grid, the new one on its server or on another; who writes into it meanwhile gets an error, who reads waits a moment at most.';

-- Removes the copies that a division of tiles has left: no statement that is planned now needs them, and those that were planned
-- before have ended, or are told so by algebra3d_shard_ready.
CREATE PROCEDURE algebra3d_shard_trim(relation text) LANGUAGE plpgsql AS $$
DECLARE
  known @extschema@.algebra3d_shard_relations := @extschema@.algebra3d_shard_relation(relation);
  names text[];
  locked text[];
  divided integer;
BEGIN
  SELECT array_agg(r.relation), array_agg(format('%I.%I', r.schema_name, r.name || '_tiles') ORDER BY r.relation) INTO names, locked
    FROM @extschema@.algebra3d_shard_relations r WHERE r.grid::text = known.grid::text;
  PERFORM @extschema@.algebra3d_shard_lock(locked, '{}');
  UPDATE @extschema@.algebra3d_shard_relations r SET fewest_tiles = @extschema@.tile_count(r.grid) WHERE r.relation = ANY (names);
  COMMIT;
  FOR known IN UPDATE @extschema@.algebra3d_shard_relations r SET split_tiles = '{}' FROM
      (SELECT o.relation, o.split_tiles FROM @extschema@.algebra3d_shard_relations o WHERE o.relation = ANY (names) ORDER BY o.relation FOR NO KEY UPDATE) o
      WHERE r.relation = o.relation RETURNING r.relation, r.schema_name, r.name, r.geometry, r.geometry_type, r.columns, r.grid, r.reach, r.fewest_tiles, o.split_tiles LOOP
    FOR divided IN SELECT DISTINCT unnest(known.split_tiles) ORDER BY 1 LOOP
      PERFORM pg_catalog.pg_advisory_xact_lock(pg_catalog.hashtext('algebra3d ' || known.relation), divided);
      PERFORM @extschema@.algebra3d_shard_execute(t.server, format('DELETE FROM %I.%I WHERE NOT tile = ANY (@extschema@.algebra3d_shard_tiles_of(box, %L::@extschema@.grid, %L::float8))',
        known.schema_name, @extschema@.algebra3d_shard_tile_name(known, divided), known.grid, known.reach))
        FROM @extschema@.algebra3d_shard_tiles t WHERE t.relation = known.relation AND t.tile = divided;
    END LOOP;
  END LOOP;
  COMMIT;
END $$;
COMMENT ON PROCEDURE algebra3d_shard_trim(text) IS 'Removes copies that a division of a tile has left which broke off.';

-- Divides a relation anew, by another grid and over other servers: rows are copied while others read, then all tiles are exchanged at once.
CREATE PROCEDURE algebra3d_shard_divide(relation text, grid @extschema@.grid, servers text[]) LANGUAGE plpgsql AS $$
DECLARE
  known @extschema@.algebra3d_shard_relations := @extschema@.algebra3d_shard_relation(relation);
  new_one @extschema@.algebra3d_shard_relations := known;
  parent text := format('%I.%I', known.schema_name, known.name || '_tiles');
  view_name text := format('%I.%I', known.schema_name, known.name);
  prefix text := known.name || '_anew';
  columns text := (SELECT string_agg(format('%I', c), ', ') FROM unnest(known.columns) c);
  definitions text;
  old_servers name[];
  old_tiles integer[];
  bytes float8;
BEGIN
  new_one.grid := grid;
  new_one.fewest_tiles := 0;
  new_one.split_tiles := '{}';
  new_one.relation := format('%s (%s)', view_name, coalesce(substring(known.relation from ' \((\d+)\)$')::integer, 0) + 1);
  -- Who writes is told so, as by algebra3d_shard_move.
  PERFORM pg_catalog.pg_advisory_xact_lock(pg_catalog.hashtext('algebra3d ' || known.relation), t.tile)
    FROM (SELECT t.tile FROM @extschema@.algebra3d_shard_tiles t WHERE t.relation = known.relation ORDER BY t.tile) t;
  PERFORM @extschema@.algebra3d_shard_ready(known.relation);
  SELECT string_agg(c.definition, ', ') || ', ' || @extschema@.algebra3d_shard_added_columns(known.geometry, known.geometry_type) INTO definitions
    FROM @extschema@.algebra3d_shard_columns(parent::regclass) c WHERE c.name = ANY (known.columns);
  EXECUTE format('SELECT avg(pg_column_size(%I)) FROM (SELECT %1$I FROM %s LIMIT 1000) q', known.geometry, parent) INTO bytes;
  PERFORM @extschema@.algebra3d_shard_run_all(@extschema@.algebra3d_shard_tiles_script(new_one, servers, definitions, bytes, prefix));
  EXECUTE format(
    'INSERT INTO %1$I.%2$I (%3$s, row_id, tile, home, born, stamp) SELECT %3$s, row_id, n.tile, n.tile = @extschema@.algebra3d_shard_home_of(box, $1), 0, stamp '
    'FROM %4$s, unnest(@extschema@.algebra3d_shard_tiles_of(box, $1, $2)) AS n(tile) WHERE home AND died IS NULL',
    known.schema_name, prefix || '_tiles', columns, parent) USING new_one.grid, new_one.reach;
  PERFORM @extschema@.algebra3d_shard_execute(t.server, format('ANALYZE %I.%I', new_one.schema_name, @extschema@.algebra3d_shard_tile_name(new_one, t.tile)))
    FROM @extschema@.algebra3d_shard_tiles t WHERE t.relation = new_one.relation ORDER BY t.tile;

  PERFORM @extschema@.algebra3d_shard_lock(ARRAY[parent], view_name || ARRAY(SELECT format('%I.%I', known.schema_name, known.name || '_' || t.total) FROM @extschema@.algebra3d_shard_totals(known) t));
  SELECT array_agg(t.server ORDER BY t.tile), array_agg(t.tile ORDER BY t.tile) INTO old_servers, old_tiles
    FROM @extschema@.algebra3d_shard_tiles t WHERE t.relation = known.relation;
  EXECUTE format('ALTER TABLE %s RENAME TO %I', parent, known.name || '_tiles_before');
  EXECUTE format('ALTER TABLE %I.%I RENAME TO %I', known.schema_name, prefix || '_tiles', known.name || '_tiles');
  DELETE FROM @extschema@.algebra3d_shard_relations r WHERE r.relation = known.relation;
  PERFORM @extschema@.algebra3d_shard_run_all(@extschema@.algebra3d_shard_view_script(new_one) || @extschema@.algebra3d_shard_functions_script(new_one));
  EXECUTE format('DROP TABLE %I.%I CASCADE', known.schema_name, known.name || '_tiles_before');
  FOR i IN 0 .. @extschema@.tile_count(grid) - 1 LOOP
    EXECUTE format('ALTER FOREIGN TABLE %I.%I RENAME TO %I', known.schema_name, prefix || '_' || i, known.name || '_' || i);
  END LOOP;
  PERFORM @extschema@.algebra3d_shard_grant_again(new_one.relation);
  COMMIT;
  -- Not before: until then the old tiles are those that count.
  FOR i IN 1 .. cardinality(old_tiles) LOOP
    PERFORM @extschema@.algebra3d_shard_execute(old_servers[i],
      format('DROP TABLE %I.%I', known.schema_name, @extschema@.algebra3d_shard_tile_name(known, old_tiles[i])));
    PERFORM @extschema@.algebra3d_shard_execute(old_servers[i], format(
      'DELETE FROM @extschema@.algebra3d_shard_generations WHERE relation = %L AND tile = %s', known.relation, old_tiles[i]));
  END LOOP;
END $$;
COMMENT ON PROCEDURE algebra3d_shard_divide(text, @extschema@.grid, text[]) IS 'Divides a relation anew: who writes into it meanwhile gets an error, who reads waits a moment at most. Its joins are to be made anew.';

-- What is wrong with a server.
CREATE FUNCTION algebra3d_shard_check_server(server name) RETURNS TABLE (object text, fault text, remedy text) LANGUAGE plpgsql VOLATILE
SET search_path = @extschema@, pg_temp AS $$
DECLARE
  options text[] := (SELECT s.srvoptions FROM pg_foreign_server s WHERE s.srvname = server);
  one record;
BEGIN
  object := 'server ' || server;
  FOR one IN SELECT w.name, w.wanted, o.option_value AS found FROM (VALUES ('async_capable', '{true}'), ('extensions', '{algebra3d,algebra3d_shards}'), ('fdw_tuple_cost', '{10}')) w(name, wanted)
      LEFT JOIN pg_options_to_table(options) o ON o.option_name = w.name LOOP
    IF one.found IS NULL OR NOT one.wanted::text[] <@ regexp_split_to_array(one.found, '\s*,\s*') THEN
      fault := format('option %s is %s', one.name, coalesce(one.found, 'missing'));
      remedy := format('SELECT algebra3d_shard_server(%L)', server);
      RETURN NEXT;
    END IF;
  END LOOP;
  IF NOT EXISTS (SELECT FROM pg_user_mappings u WHERE u.srvname = server AND u.usename IN (current_user, 'public')) THEN
    fault := format('%s has no user mapping', current_user);
    remedy := format('CREATE USER MAPPING FOR %I SERVER %I OPTIONS (user ..., password ...)', current_user, server);
    RETURN NEXT;
    RETURN;
  END IF;
  FOR one IN EXECUTE format('SELECT h.extname, h.extversion AS here, t.extversion AS there, '
      'string_to_array(t.extversion, ''.'') < string_to_array(h.extversion, ''.'') AS is_older FROM pg_extension h LEFT JOIN %I t USING (extname) '
      'WHERE h.extname IN (''algebra3d'', ''algebra3d_shards'') AND h.extversion IS DISTINCT FROM t.extversion ORDER BY 1', 'algebra3d_extensions_' || server) LOOP
    fault := format('extension %s is %s there, %s here', one.extname, coalesce(one.there, 'missing'), one.here);
    remedy := CASE WHEN one.is_older THEN format('SELECT algebra3d_shard_execute(%L, %L)', server, format('ALTER EXTENSION %I UPDATE', one.extname))
      ELSE format('ALTER EXTENSION %I UPDATE', one.extname) END;
    IF one.there IS NULL THEN
      remedy := format('on it: CREATE EXTENSION %I SCHEMA %s CASCADE', one.extname, '@extschema@');
      RETURN NEXT;
      RETURN;
    END IF;
    RETURN NEXT;
  END LOOP;
  FOR one IN EXECUTE format(
      'SELECT t.tile, format(''%%I.%%I'', r.schema_name, algebra3d_shard_tile_name(r, t.tile)) AS name, r.geometry, f.checks, f.is_indexed, '
      'f.generated, algebra3d_shard_generated(to_regclass(format(''%%I.%%I'', r.schema_name, r.name || ''_tiles''))) AS generated_here '
      'FROM algebra3d_shard_tiles t JOIN algebra3d_shard_relations r USING (relation) LEFT JOIN %I f ON f.schema_name = r.schema_name '
      'AND f.table_name = algebra3d_shard_tile_name(r, t.tile) WHERE t.server = $1 ORDER BY r.relation, t.tile', 'algebra3d_tables_' || server) USING server LOOP
    object := format('server %s, table %s', server, one.name);
    IF one.is_indexed IS NULL THEN
      fault := 'the table of a tile is missing';
      remedy := 'restore its server from a backup';
      RETURN NEXT;
      CONTINUE;
    END IF;
    IF NOT coalesce(format('CHECK ((tile = %s))', one.tile) = ANY (one.checks), false) THEN
      fault := 'the condition is missing that all rows are of its tile';
      remedy := format('SELECT algebra3d_shard_execute(%L, %L)', server, format('ALTER TABLE %s ADD CHECK (tile = %s)', one.name, one.tile));
      RETURN NEXT;
    END IF;
    IF NOT one.is_indexed THEN
      fault := format('the index on %I is missing', one.geometry);
      remedy := format('SELECT algebra3d_shard_execute(%L, %L)', server, format('CREATE INDEX ON %s USING gist (%I)', one.name, one.geometry));
      RETURN NEXT;
    END IF;
    FOR fault, remedy IN
        SELECT format('column %s is not generated as here', c.name), format('SELECT algebra3d_shard_execute(%L, %L)', server,
          format('ALTER TABLE %s DROP COLUMN IF EXISTS %s, ADD COLUMN %s', one.name, c.name, c.definition))
        FROM (SELECT split_part(g, ' ', 1) AS name, g AS definition FROM unnest(one.generated_here) g) c WHERE NOT coalesce(c.definition = ANY (one.generated), false) LOOP
      RETURN NEXT;
    END LOOP;
  END LOOP;
  -- Servers may name one database.
  FOR one IN EXECUTE format(
      'SELECT f.schema_name, f.table_name FROM %I f JOIN algebra3d_shard_relations r ON r.schema_name = f.schema_name AND f.table_name ~ (''^'' || r.name || ''_(v\d+_)?\d+$'') '
      'WHERE NOT EXISTS (SELECT FROM algebra3d_shard_tiles t JOIN pg_foreign_server s ON s.srvname = t.server WHERE t.relation = r.relation '
      'AND f.table_name = algebra3d_shard_tile_name(r, t.tile) AND algebra3d_shard_address(s.srvoptions) IS NOT DISTINCT FROM $1) ORDER BY 1, 2', 'algebra3d_tables_' || server)
      USING algebra3d_shard_address(options) LOOP
    object := format('server %s, table %I.%I', server, one.schema_name, one.table_name);
    fault := 'a tile that lies elsewhere now';
    remedy := format('SELECT algebra3d_shard_execute(%L, %L)', server, format('DROP TABLE %I.%I', one.schema_name, one.table_name));
    RETURN NEXT;
  END LOOP;
EXCEPTION WHEN OTHERS THEN
  object := 'server ' || server;
  GET STACKED DIAGNOSTICS fault = PG_EXCEPTION_DETAIL;
  fault := concat_ws(': ', SQLERRM, nullif(fault, ''));
  remedy := CASE WHEN SQLSTATE IN ('42P01', '3F000', '42883') THEN format('on it: CREATE EXTENSION algebra3d_shards SCHEMA %s CASCADE, after DROP EXTENSION if it is in another schema', '@extschema@')
    WHEN SQLSTATE = '42501' THEN 'on it: GRANT what is missing to the role of the user mapping'
    ELSE 'start it, and see its options and user mapping' END;
  RETURN NEXT;
END $$;

-- What is wrong with the tiles of relations here.
CREATE FUNCTION algebra3d_shard_check_tiles() RETURNS TABLE (object text, fault text, remedy text) LANGUAGE plpgsql VOLATILE
SET search_path = @extschema@, pg_temp AS $$
DECLARE
  one record;
  made text;
BEGIN
  FOR one IN SELECT r, t.relation, t.tile, t.server, s.srvname AS server_here, algebra3d_shard_address(f.ftoptions) AS place, i.inhrelid IS NOT NULL AS is_attached,
      algebra3d_shard_address(ARRAY['schema_name=' || r.schema_name, 'table_name=' || algebra3d_shard_tile_name(r, t.tile)]) AS expected,
      format('%I.%I', r.schema_name, r.name || '_' || t.tile) AS name, format('%I.%I', r.schema_name, r.name || '_tiles') AS parent
      FROM algebra3d_shard_relations r JOIN algebra3d_shard_tiles t USING (relation)
      LEFT JOIN pg_foreign_table f ON f.ftrelid = to_regclass(format('%I.%I', r.schema_name, r.name || '_' || t.tile)) LEFT JOIN pg_foreign_server s ON s.oid = f.ftserver
      LEFT JOIN pg_inherits i ON i.inhrelid = f.ftrelid ORDER BY t.relation, t.tile LOOP
    object := format('relation %s, tile %s', one.relation, one.tile);
    made := algebra3d_shard_foreign_table_script(one.r, one.tile, one.server, (one.r).name || '_' || one.tile, format('PARTITION OF %s FOR VALUES IN (%s)', one.parent, one.tile), NULL);
    IF one.server_here IS NULL THEN
      fault := 'its foreign table is missing';
      remedy := made;
      RETURN NEXT;
    ELSIF one.server_here <> one.server THEN
      fault := format('its foreign table names server %s, and its rows are on %s', one.server_here, one.server);
      remedy := format('DROP FOREIGN TABLE %s; %s', one.name, made);
      RETURN NEXT;
    ELSE
      IF one.place IS DISTINCT FROM one.expected THEN
        fault := format('its foreign table names %s, expected %s: rows of that one count twice', one.place, one.expected);
        remedy := format('ALTER FOREIGN TABLE %s OPTIONS (SET schema_name %L, SET table_name %L)', one.name, (one.r).schema_name, algebra3d_shard_tile_name(one.r, one.tile));
        RETURN NEXT;
      END IF;
      IF NOT one.is_attached THEN
        fault := 'its foreign table belongs to no partitioned table';
        remedy := format('ALTER TABLE %s ATTACH PARTITION %s FOR VALUES IN (%s)', one.parent, one.name, one.tile);
        RETURN NEXT;
      END IF;
    END IF;
  END LOOP;
  FOR object, fault, remedy IN
      SELECT format('relations %s and %s, tile %s', a.relation, b.relation, a.tile), format('is on %s, and on %s: their join brings its rows here', a.server, b.server),
        format('CALL algebra3d_shard_move(%L, %s, %L)', b.relation, b.tile, a.server)
      FROM algebra3d_shard_joins j JOIN algebra3d_shard_tiles a ON a.relation = j.a JOIN algebra3d_shard_tiles b ON b.relation = j.b AND b.tile = a.tile
      WHERE a.server <> b.server ORDER BY 1 LOOP
    RETURN NEXT;
  END LOOP;
  FOR object, fault, remedy IN
      SELECT format('relation %s', r.relation), format('tiles %s still have copies of before they were divided', array_to_string(r.split_tiles, ', ')), format('CALL algebra3d_shard_trim(%L)', r.relation)
      FROM algebra3d_shard_relations r WHERE r.split_tiles <> '{}' ORDER BY 1 LOOP
    RETURN NEXT;
  END LOOP;
END $$;

CREATE FUNCTION algebra3d_shard_check() RETURNS TABLE (object text, fault text, remedy text) LANGUAGE plpgsql VOLATILE AS $$
DECLARE
  one record;
BEGIN
  RETURN QUERY SELECT 'database ' || current_database(), s || ' is off: joins and counts bring all rows here',
    format('ALTER DATABASE %I SET %2$s = on; SET %2$s = on', current_database(), s)
    FROM unnest('{enable_partitionwise_join,enable_partitionwise_aggregate}'::text[]) s WHERE pg_catalog.current_setting(s) <> 'on';
  RETURN QUERY SELECT c.* FROM (SELECT DISTINCT t.server FROM @extschema@.algebra3d_shard_tiles t ORDER BY 1) t, @extschema@.algebra3d_shard_check_server(t.server) c;
  RETURN QUERY SELECT c.* FROM @extschema@.algebra3d_shard_check_tiles() c;
  FOR one IN SELECT r.relation FROM @extschema@.algebra3d_shard_relations r ORDER BY 1 LOOP
    BEGIN
      RETURN QUERY SELECT format('relation %s, tile %s', one.relation, d.tile), format('generation %s on its server, %s here', coalesce(d.there::text, 'none'), d.here),
        CASE WHEN d.there = d.here + 1 THEN 'SELECT * FROM algebra3d_shard_repair()' WHEN d.there > d.here THEN 'restore the coordinator from a newer backup' ELSE 'restore its server from a newer backup' END
        FROM @extschema@.algebra3d_shard_differences(one.relation) d;
    EXCEPTION WHEN OTHERS THEN
      NULL;  -- what is wrong with a server was said above
    END;
  END LOOP;
END $$;
COMMENT ON FUNCTION algebra3d_shard_check() IS 'What is wrong with relations over several servers, and what helps; no rows if nothing is.';
