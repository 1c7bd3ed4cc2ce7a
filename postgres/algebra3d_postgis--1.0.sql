\echo Use "CREATE EXTENSION algebra3d_postgis" to load this file. \quit

-- Values of algebra3d have no SRID. So a geometry that has one is read by a function that names it, and a cast, which
-- cannot, takes only geometries without: it is never dropped. Functions are parsed when they are created, so they need no
-- search_path. Cost: that of well-known binary, linear, and of the proof of solids and surfaces.

CREATE FUNCTION volume3d(geometry, srid bigint DEFAULT 0) RETURNS volume3d LANGUAGE SQL IMMUTABLE STRICT PARALLEL SAFE COST 1000
  RETURN from_wkb(ST_AsEWKB($1), srid);
COMMENT ON FUNCTION volume3d(geometry, bigint) IS 'The solid that a POLYHEDRALSURFACE Z or TIN Z with this SRID bounds, 0: none.';
CREATE FUNCTION surface3d(geometry, srid bigint DEFAULT 0) RETURNS surface3d LANGUAGE SQL IMMUTABLE STRICT PARALLEL SAFE COST 1000
  RETURN surface_from_wkb(ST_AsEWKB($1), srid);
COMMENT ON FUNCTION surface3d(geometry, bigint) IS 'The surface of a POLYHEDRALSURFACE Z, TIN Z or POLYGON Z with this SRID, 0: none.';
CREATE FUNCTION mesh3d(geometry, srid bigint DEFAULT 0) RETURNS mesh3d LANGUAGE SQL IMMUTABLE STRICT PARALLEL SAFE COST 1000
  RETURN mesh_from_wkb(ST_AsEWKB($1), srid);
COMMENT ON FUNCTION mesh3d(geometry, bigint) IS 'The faces of a POLYHEDRALSURFACE Z, TIN Z or POLYGON Z with this SRID, 0: none.';
CREATE FUNCTION points3d(geometry, srid bigint DEFAULT 0) RETURNS points3d LANGUAGE SQL IMMUTABLE STRICT PARALLEL SAFE COST 100
  RETURN points_from_wkb(ST_AsEWKB($1), srid);
COMMENT ON FUNCTION points3d(geometry, bigint) IS 'The points of a POINT Z, MULTIPOINT Z or LINESTRING Z with this SRID, 0: none.';
CREATE FUNCTION point3d(geometry, srid bigint DEFAULT 0) RETURNS point3d LANGUAGE SQL IMMUTABLE STRICT PARALLEL SAFE COST 100
  RETURN point_from_wkb(ST_AsEWKB($1), srid);
COMMENT ON FUNCTION point3d(geometry, bigint) IS 'The point of a POINT Z with this SRID, 0: none.';
CREATE FUNCTION region(geometry, srid bigint DEFAULT 0) RETURNS region LANGUAGE SQL IMMUTABLE STRICT PARALLEL SAFE COST 100
  RETURN region_from_wkb(ST_AsEWKB($1), srid);
COMMENT ON FUNCTION region(geometry, bigint) IS 'The region of a POLYGON or MULTIPOLYGON with this SRID, 0: none.';

CREATE FUNCTION geometry(volume3d, srid bigint DEFAULT 0) RETURNS geometry LANGUAGE SQL IMMUTABLE STRICT PARALLEL SAFE COST 1000
  RETURN ST_GeomFromEWKB(to_wkb($1, srid));
COMMENT ON FUNCTION geometry(volume3d, bigint) IS 'The triangles of a solid as a POLYHEDRALSURFACE Z with an SRID.';
CREATE FUNCTION geometry(surface3d, srid bigint DEFAULT 0) RETURNS geometry LANGUAGE SQL IMMUTABLE STRICT PARALLEL SAFE COST 1000
  RETURN ST_GeomFromEWKB(to_wkb($1, srid));
COMMENT ON FUNCTION geometry(surface3d, bigint) IS 'A surface as a TIN Z with an SRID.';
CREATE FUNCTION geometry(mesh3d, srid bigint DEFAULT 0) RETURNS geometry LANGUAGE SQL IMMUTABLE STRICT PARALLEL SAFE COST 1000
  RETURN ST_GeomFromEWKB(to_wkb($1, srid));
COMMENT ON FUNCTION geometry(mesh3d, bigint) IS 'The faces of a mesh as a POLYHEDRALSURFACE Z with an SRID.';
CREATE FUNCTION geometry(points3d, srid bigint DEFAULT 0) RETURNS geometry LANGUAGE SQL IMMUTABLE STRICT PARALLEL SAFE COST 100
  RETURN ST_GeomFromEWKB(to_wkb($1, srid));
COMMENT ON FUNCTION geometry(points3d, bigint) IS 'Points as a MULTIPOINT Z with an SRID.';
CREATE FUNCTION geometry(point3d, srid bigint DEFAULT 0) RETURNS geometry LANGUAGE SQL IMMUTABLE STRICT PARALLEL SAFE COST 100
  RETURN ST_GeomFromEWKB(to_wkb($1, srid));
COMMENT ON FUNCTION geometry(point3d, bigint) IS 'A point as a POINT Z with an SRID.';
CREATE FUNCTION geometry(region, srid bigint DEFAULT 0) RETURNS geometry LANGUAGE SQL IMMUTABLE STRICT PARALLEL SAFE COST 100
  RETURN ST_GeomFromEWKB(to_wkb($1, srid));
COMMENT ON FUNCTION geometry(region, bigint) IS 'A region as a MULTIPOLYGON with an SRID.';

-- A cast calls a function of one parameter: the SRID is that of none.
CREATE FUNCTION volume3d_without_srid(geometry) RETURNS volume3d LANGUAGE SQL IMMUTABLE STRICT PARALLEL SAFE RETURN volume3d($1, 0);
CREATE CAST (geometry AS volume3d) WITH FUNCTION volume3d_without_srid(geometry);
CREATE FUNCTION geometry_without_srid(volume3d) RETURNS geometry LANGUAGE SQL IMMUTABLE STRICT PARALLEL SAFE RETURN geometry($1, 0);
CREATE CAST (volume3d AS geometry) WITH FUNCTION geometry_without_srid(volume3d);
CREATE FUNCTION surface3d_without_srid(geometry) RETURNS surface3d LANGUAGE SQL IMMUTABLE STRICT PARALLEL SAFE RETURN surface3d($1, 0);
CREATE CAST (geometry AS surface3d) WITH FUNCTION surface3d_without_srid(geometry);
CREATE FUNCTION geometry_without_srid(surface3d) RETURNS geometry LANGUAGE SQL IMMUTABLE STRICT PARALLEL SAFE RETURN geometry($1, 0);
CREATE CAST (surface3d AS geometry) WITH FUNCTION geometry_without_srid(surface3d);
CREATE FUNCTION mesh3d_without_srid(geometry) RETURNS mesh3d LANGUAGE SQL IMMUTABLE STRICT PARALLEL SAFE RETURN mesh3d($1, 0);
CREATE CAST (geometry AS mesh3d) WITH FUNCTION mesh3d_without_srid(geometry);
CREATE FUNCTION geometry_without_srid(mesh3d) RETURNS geometry LANGUAGE SQL IMMUTABLE STRICT PARALLEL SAFE RETURN geometry($1, 0);
CREATE CAST (mesh3d AS geometry) WITH FUNCTION geometry_without_srid(mesh3d);
CREATE FUNCTION points3d_without_srid(geometry) RETURNS points3d LANGUAGE SQL IMMUTABLE STRICT PARALLEL SAFE RETURN points3d($1, 0);
CREATE CAST (geometry AS points3d) WITH FUNCTION points3d_without_srid(geometry);
CREATE FUNCTION geometry_without_srid(points3d) RETURNS geometry LANGUAGE SQL IMMUTABLE STRICT PARALLEL SAFE RETURN geometry($1, 0);
CREATE CAST (points3d AS geometry) WITH FUNCTION geometry_without_srid(points3d);
CREATE FUNCTION point3d_without_srid(geometry) RETURNS point3d LANGUAGE SQL IMMUTABLE STRICT PARALLEL SAFE RETURN point3d($1, 0);
CREATE CAST (geometry AS point3d) WITH FUNCTION point3d_without_srid(geometry);
CREATE FUNCTION geometry_without_srid(point3d) RETURNS geometry LANGUAGE SQL IMMUTABLE STRICT PARALLEL SAFE RETURN geometry($1, 0);
CREATE CAST (point3d AS geometry) WITH FUNCTION geometry_without_srid(point3d);
CREATE FUNCTION region_without_srid(geometry) RETURNS region LANGUAGE SQL IMMUTABLE STRICT PARALLEL SAFE RETURN region($1, 0);
CREATE CAST (geometry AS region) WITH FUNCTION region_without_srid(geometry);
CREATE FUNCTION geometry_without_srid(region) RETURNS geometry LANGUAGE SQL IMMUTABLE STRICT PARALLEL SAFE RETURN geometry($1, 0);
CREATE CAST (region AS geometry) WITH FUNCTION geometry_without_srid(region);
