-- The tour of scripts/postgres: statements on the sample parts, which the table `parts` holds (name text, solid volume3d).
\set QUIET on
\pset footer off

-- Solids are values. The union of two cubes, exactly:
SELECT volume(create_cube('(0 0 0)', '(2 2 2)') + create_cube('(1 1 1)', '(3 3 3)'));

-- The table of parts, and its largest ones:
SELECT count(*) AS parts, sum(size(solid)) AS triangles, pg_size_pretty(pg_total_relation_size('parts')) AS stored FROM parts;
SELECT name, size(solid) AS triangles, round(volume(solid)::numeric, 2) AS volume, round(area(solid)::numeric, 2) AS area
  FROM parts ORDER BY volume(solid) DESC, name LIMIT 5;

-- The box around all parts, and the parts that are nearest to the origin:
SELECT as_text(extent(solid)) FROM parts;
SELECT name, round((solid <-> point3d(0, 0, 0))::numeric, 3) AS distance FROM parts WHERE NOT is_empty(solid)
  ORDER BY 2, 1 LIMIT 3;

-- Which small parts overlap where their files put them: boxes first (&&), then the solids themselves.
SELECT count(*) AS pairs FROM parts a JOIN parts b ON a.name < b.name AND a.solid && b.solid AND intersects(a.solid, b.solid)
  WHERE size(a.solid) < 500 AND size(b.solid) < 500;

-- A hole through the largest small part: its volume before and after, and the bodies that are left.
CREATE TEMP TABLE drilled AS
  SELECT name, solid AS whole, solid - create_cylinder(centroid(solid), 2, 1000, 24) AS solid FROM parts WHERE size(solid) < 500
  ORDER BY volume(solid) DESC, name LIMIT 1;
SELECT name, volume(whole) AS before, volume(solid) AS after FROM drilled;
SELECT size(body) AS triangles, as_text(bbox(body)) AS box FROM drilled, components(solid) body LIMIT 3;

-- What yields no value says why, and is NULL:
SELECT create_cube('(0 0 0)', '(1 1 0)') IS NULL AS missing;

-- A statement that takes too long ends in time, and the session goes on:
SET statement_timeout = '300ms';
SELECT volume(union_agg(create_sphere(point3d(i * 0.01, 0, 0), 1, 200 + i))) FROM generate_series(1, 100) i;
RESET statement_timeout;
SELECT volume(create_cube('(0 0 0)', '(1 2 3)'));
